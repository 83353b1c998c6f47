//! Limit-determinism decided a second time, letter by letter and with the plainest means, on the files of other tools where they are
//! there (`../shared/ltl/hoa`). Only automata with labels on edges, without aliases, over few propositions are looked at.

use ltl_rover::automaton::hoa::{self, HoaErrorKind, StreamItem};
use std::path::{Path, PathBuf};

/// An automaton, letter by letter.
struct Plain {
    starts: usize,
    propositions: usize,
    /// Bits of the sets that must be visited.
    sets: u64,
    /// Per state: (label, target, sets).
    edges: Vec<Vec<(String, usize, u64)>>,
}

/// Reads the common core of the format by splitting strings; `None` for anything else.
fn read(text: &str) -> Option<Plain> {
    let (header, body) = text.split_once("--BODY--")?;
    if ["/*", "Alias:", "!)"].iter().any(|odd| text.contains(odd)) {
        return None;
    }
    let field = |name: &str| header.split_once(name).map(|(_, rest)| rest.trim_start());
    let number = |text: &str| text.chars().take_while(char::is_ascii_digit).collect::<String>().parse::<usize>().ok();
    let condition: String = field("Acceptance:")?.lines().next()?.to_owned();
    let mut sets = 0;
    for atom in condition.split("Inf(").skip(1) {
        sets |= 1 << number(atom)?;
    }
    if condition.contains("Fin") || condition.contains('|') {
        return None;
    }
    let count = number(field("States:")?)?;
    let mut edges = vec![Vec::new(); count];
    for state in body.split("State:").skip(1) {
        let (mut own, mut number_read, mut q, mut label) = (0, false, 0, None);
        let mut rest = state.split("--END--").next()?.trim_start();
        while let Some(first) = rest.chars().next() {
            let (piece, after) = match first {
                '[' => (rest[1..].split(']').next()?, &rest[rest.find(']')? + 1..]),
                '{' => (rest[1..].split('}').next()?, &rest[rest.find('}')? + 1..]),
                '"' => ("", &rest[1 + rest[1..].find('"')? + 1..]),
                '0'..='9' => {
                    let end = rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len());
                    (&rest[..end], &rest[end..])
                }
                _ => return None,
            };
            rest = after.trim_start();
            let bits =
                || piece.split_whitespace().try_fold(0u64, |all, n| Some(all | 1 << n.parse::<u32>().ok().filter(|n| *n < 64)?));
            match first {
                '[' => label = Some(piece.to_owned()),
                '{' => match edges[q].last_mut() {
                    Some((_, _, marks)) => *marks |= bits()?,
                    None => own = bits()?,
                },
                '0'..='9' if !number_read => (q, number_read) = (piece.parse().ok().filter(|q| *q < count)?, true),
                '0'..='9' => edges[q].push((label.take()?, piece.parse().ok().filter(|q| *q < count)?, own)),
                _ => {}
            }
        }
        if label.is_some() {
            return None;
        }
    }
    let propositions = field("AP:").map_or(Some(0), number)?;
    Some(Plain { starts: header.matches("Start:").count(), propositions, sets, edges })
}

/// Whether a letter satisfies a label: disjunction, conjunction, negation by recursive descent.
fn holds(label: &mut std::iter::Peekable<std::vec::IntoIter<char>>, letter: u32) -> bool {
    let mut any = false;
    loop {
        let mut all = true;
        loop {
            all &= literal(label, letter);
            if label.next_if_eq(&'&').is_none() {
                break;
            }
        }
        any |= all;
        if label.next_if_eq(&'|').is_none() {
            return any;
        }
    }
}

fn literal(label: &mut std::iter::Peekable<std::vec::IntoIter<char>>, letter: u32) -> bool {
    match label.next().unwrap() {
        '!' => !literal(label, letter),
        '(' => {
            let inner = holds(label, letter);
            assert_eq!(label.next(), Some(')'));
            inner
        }
        't' => true,
        'f' => false,
        digit => {
            let mut index = digit.to_digit(10).unwrap();
            while let Some(next) = label.next_if(char::is_ascii_digit) {
                index = 10 * index + next.to_digit(10).unwrap();
            }
            letter >> index & 1 == 1
        }
    }
}

/// Whether everything that can be reached from accepting cycles is deterministic, choices of which nothing comes apart.
fn limit_deterministic(plain: &Plain) -> bool {
    let count = plain.edges.len();
    let letters = 1u32 << plain.propositions;
    let mut leads = vec![vec![vec![false; count]; letters as usize]; count];
    let mut reach = vec![vec![false; count]; count];
    for (q, list) in plain.edges.iter().enumerate() {
        for (label, target, _) in list {
            let characters: Vec<char> = label.chars().filter(|c| !c.is_whitespace()).collect();
            for letter in 0..letters {
                if holds(&mut characters.clone().into_iter().peekable(), letter) {
                    leads[q][letter as usize][*target] = true;
                    reach[q][*target] = true;
                }
            }
        }
    }
    for via in 0..count {
        for from in 0..count {
            if reach[from][via] {
                let further = reach[via].clone();
                reach[from].iter_mut().zip(further).for_each(|(known, more)| *known |= more);
            }
        }
    }
    // q is accepting if it lies on a cycle, and its component's edges have all sets.
    let together = |p: usize, q: usize| reach[p][q] && reach[q][p];
    let accepting: Vec<bool> = (0..count)
        .map(|q| {
            let inside = (0..count).filter(|p| together(*p, q));
            let marks = inside.flat_map(|p| plain.edges[p].iter().filter(move |(_, to, _)| together(*to, q)).map(|(_, _, m)| *m));
            reach[q][q] && marks.fold(0, |all, m| all | m) & plain.sets == plain.sets
        })
        .collect();
    let live: Vec<bool> = (0..count).map(|q| accepting[q] || (0..count).any(|to| reach[q][to] && accepting[to])).collect();
    let choice =
        |q: usize| (0..letters as usize).any(|letter| (0..count).filter(|to| leads[q][letter][*to] && live[*to]).count() > 1);
    (0..count).filter(|q| accepting[*q]).all(|q| !choice(q) && (0..count).all(|to| !reach[q][to] || !choice(to)))
}

fn files(path: &Path, found: &mut Vec<PathBuf>) {
    if path.is_dir() {
        std::fs::read_dir(path).unwrap().for_each(|entry| files(&entry.unwrap().path(), found));
    } else if path.extension().is_some_and(|extension| extension == "hoa") {
        found.push(path.to_owned());
    }
}

#[test]
fn limit_determinism_is_decided_alike() {
    let mut found = Vec::new();
    files(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/ltl/hoa"), &mut found);
    let (mut yes, mut no) = (0, 0);
    for path in &found {
        let text = String::from_utf8_lossy(&std::fs::read(path).unwrap()).into_owned();
        let pieces: Vec<&str> = text.split_inclusive("--END--").filter(|piece| piece.contains("--END--")).collect();
        let items = hoa::read_stream(&text);
        if pieces.len() != items.len() {
            continue;
        }
        for (piece, item) in pieces.iter().zip(&items) {
            let verdict = match item {
                StreamItem::Automaton(_) => true,
                StreamItem::Refused(error) if error.kind() == HoaErrorKind::NotLimitDeterministic => false,
                _ => continue,
            };
            let Some(plain) =
                read(piece).filter(|plain| plain.propositions <= 5 && plain.edges.len() <= 150 && plain.starts == 1)
            else {
                continue;
            };
            assert_eq!(verdict, limit_deterministic(&plain), "{}\n{piece}", path.display());
            *(if verdict { &mut yes } else { &mut no }) += 1;
        }
    }
    println!("{yes} limit-deterministic, {no} not");
    assert!(found.is_empty() || (yes > 200 && no > 30));
}
