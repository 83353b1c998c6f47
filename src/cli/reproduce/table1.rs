//! Table 1 of [Cai et al. 2021](crate::bib::Cai2021): success over 200 runs, per policy and over training seeds.

use super::chart::{self, Dots, Scale};
use super::contest::{Contest, Row};
use super::method::Method;
use super::paper::paper;
use super::summary::bootstrap;
use super::text::{MISSING, Table, count, duration, or_missing, percent, percents};
use crate::cli::failure::Failure;
use crate::cli::files;
use crate::eval::Interval;
use serde_json::json;
use std::fmt::Write;

/// Writes `table1.md`, `.csv`, `.json` and `.svg`.
///
/// # Errors
/// If they cannot be written.
pub fn write(contest: &Contest, rows: &[Row]) -> Result<(), Failure> {
    let path = |ending: &str| contest.campaign.out.join(contest.campaign.report_name("table1")).with_extension(ending);
    files::write(&path("md"), markdown(contest, rows))?;
    files::write(&path("csv"), csv(rows)?)?;
    let groups: Vec<_> = rows.iter().map(|row| row.group.object()).collect();
    let all = json!({ "table": 1, "recipe": contest.campaign.preset(), "changes": contest.campaign.changes(), "rows": groups });
    files::write(&path("json"), serde_json::to_string_pretty(&all).expect("plain data has a form in JSON") + "\n")?;
    let dots: Vec<Dots> = rows
        .iter()
        .filter_map(|row| {
            let middle = row.group.rate()?;
            let interval = row.group.interval().unwrap_or(Interval { low: middle, high: middle });
            let label = format!("{}  {}", short(&row.group.task), row.method.title());
            Some(Dots { label, colour: row.method as usize, middle, interval, values: row.group.rates() })
        })
        .collect();
    if dots.is_empty() {
        return Ok(());
    }
    chart::dots(
        &path("svg"),
        Scale::Share,
        "success rate: interquartile mean over seeds, 95 % bootstrap interval, each seed",
        &dots,
    )
}

/// The paper's name of a task, or the task's own.
pub fn short(task: &str) -> &str {
    paper(task).map_or(task, |row| row.name)
}

fn markdown(contest: &Contest, rows: &[Row]) -> String {
    let mut text = String::from("# Success over 200 runs (Table 1 of the paper)\n\n");
    text += &contest.about(rows);
    text += "\nSuccess: at least one round of all accepting sets within the horizon, and never a sink. Over seeds: interquartile mean of\n\
             the success rates with its percentile bootstrap interval. A seed counts as solved from 99 % on. Times are the whole training, to the\n\
             first evaluation without a failure or to the end of the budget, without the evaluations in between; medians over seeds.\n\n";
    let mut table = Table::new(&[
        "task",
        ">horizon",
        "contender",
        ">paper",
        ">ours",
        "95 % over seeds",
        ">solved seeds",
        ">steps",
        ">time",
        ">processor",
    ]);
    for Row { method, group } in rows {
        let mut cells = vec![
            short(&group.task).to_owned(),
            count(group.max_steps.into()),
            method.title().to_owned(),
            paper(&group.task).and_then(|p| p.success(*method)).map_or("–".to_owned(), |p| percent(p / 100.0)),
            or_missing(group.rate(), percent),
        ];
        if group.done().next().is_some() {
            cells.extend([
                group.interval().map_or_else(String::new, percents),
                solved(group.solved(), group.done().count(), group.cells.len()),
                or_missing(group.median(|cell| Some(cell.outcome.steps as f64)), count),
                or_missing(group.median(|cell| Some(cell.outcome.training.wall)), duration),
                group.median(|cell| cell.outcome.training.processor).map_or_else(String::new, duration),
            ]);
        } else {
            cells.extend(vec![String::new(); 5]);
        }
        table.row(&cells);
    }
    text += &table.finish();
    text += "\n## All tasks together\n\nInterquartile mean over the seeds of all tasks that are run, bootstrap stratified by task.\n\n";
    let mut table = Table::new(&["contender", ">tasks", ">ours", "95 %"]);
    for method in Method::ALL {
        let rates: Vec<Vec<f64>> = rows.iter().filter(|r| r.method == method).map(|r| r.group.rates()).collect();
        let strata: Vec<&[f64]> = rates.iter().map(Vec::as_slice).filter(|rates| !rates.is_empty()).collect();
        let all: Vec<f64> = strata.concat();
        let ours = (!all.is_empty()).then(|| crate::eval::interquartile_mean(&all));
        let interval = bootstrap(&strata).map_or_else(String::new, percents);
        table.row(&[method.title().to_owned(), strata.len().to_string(), or_missing(ours, percent), interval]);
    }
    text += &table.finish();
    text += "\n## Every policy\n\nThe interval is Clopper and Pearson's for the runs of this policy.\n\n";
    let mut table = Table::new(&[
        "task",
        "contender",
        ">seed",
        ">successes",
        "95 %",
        ">rounds",
        ">sinks",
        ">steps",
        ">policy of step",
        ">time",
    ]);
    let mut missing = String::new();
    for Row { method, group } in rows {
        for cell in group.done() {
            let (o, e) = (&cell.outcome, &cell.outcome.evaluation);
            table.row(&[
                short(&group.task).to_owned(),
                method.title().to_owned(),
                cell.seed.to_string(),
                format!("{}/{}", e.successes, e.runs),
                percents(e.ci95),
                format!("{:.2}", e.rounds_mean),
                percent(e.sink_rate),
                count(o.steps as f64),
                count(o.best_step as f64),
                duration(o.training.wall),
            ]);
        }
        if group.cells.iter().any(Option::is_none) {
            let _ = writeln!(missing, "- {} {}: {} seeds", short(&group.task), method.title(), group.progress());
        }
    }
    text += &table.finish();
    if !missing.is_empty() {
        let _ = write!(text, "\n## {}\n\n{missing}", capitalised(MISSING));
    }
    text
}

/// Solved seeds of those that are run, and of how many were meant to be if that is not all.
fn solved(solved: usize, done: usize, planned: usize) -> String {
    if done == planned { format!("{solved}/{done}") } else { format!("{solved}/{done} (of {planned})") }
}

fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

fn csv(rows: &[Row]) -> Result<Vec<u8>, Failure> {
    let failed = |e: csv::Error| Failure::running(e);
    let mut table = csv::Writer::from_writer(vec![]);
    let head = "task,contender,seed,max_steps,runs,successes,success_rate,ci95_low,ci95_high,rounds_mean,sink_rate,steps,episodes,updates,\
                first_perfect_step,first_perfect_s,training_s,training_processor_s,evaluating_s,jobs,cell";
    table.write_record(head.split(',')).map_err(failed)?;
    let shown = |value: Option<f64>| value.map_or_else(String::new, |v| format!("{v:.3}"));
    for Row { method, group } in rows {
        for cell in group.done() {
            let (o, e) = (&cell.outcome, &cell.outcome.evaluation);
            let record = [
                group.task.clone(),
                method.key().to_owned(),
                cell.seed.to_string(),
                group.max_steps.to_string(),
                e.runs.to_string(),
                e.successes.to_string(),
                e.success_rate.to_string(),
                format!("{:.6}", e.ci95.low),
                format!("{:.6}", e.ci95.high),
                e.rounds_mean.to_string(),
                e.sink_rate.to_string(),
                o.steps.to_string(),
                o.episodes.to_string(),
                o.updates.to_string(),
                o.first_perfect.map_or_else(String::new, |m| m.step.to_string()),
                shown(o.first_perfect.map(|m| m.training.wall)),
                shown(Some(o.training.wall)),
                shown(o.training.processor),
                shown(Some(o.evaluating.wall)),
                cell.conditions.jobs.to_string(),
                cell.hash.clone(),
            ];
            table.write_record(record).map_err(failed)?;
        }
    }
    table.into_inner().map_err(|e| Failure::running(e.error()))
}
