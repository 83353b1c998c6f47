//! Table 2 of [Cai et al. 2021](crate::bib::Cai2021): what training costs, and what it costs until the first 200 of 200.

use super::chart::{self, Dots, Scale};
use super::contest::{Contest, Row};
use super::paper::paper;
use super::table1::short;
use super::text::{MISSING, Table, count, duration};
use crate::cli::failure::Failure;
use crate::cli::files;
use crate::eval::Interval;
use serde_json::{Value, json};

/// Writes `table2.md`, `.csv`, `.json` and `.svg`.
///
/// # Errors
/// If they cannot be written.
pub fn write(contest: &Contest, rows: &[Row]) -> Result<(), Failure> {
    let path = |ending: &str| contest.campaign.out.join(contest.campaign.report_name("table2")).with_extension(ending);
    files::write(&path("md"), markdown(contest, rows))?;
    let lines: Vec<Value> = rows.iter().map(object).collect();
    files::write(&path("csv"), csv(&lines)?)?;
    let all = json!({ "table": 2, "recipe": contest.campaign.preset(), "changes": contest.campaign.changes(), "rows": lines });
    files::write(&path("json"), serde_json::to_string_pretty(&all).expect("plain data has a form in JSON") + "\n")?;
    let dots: Vec<Dots> = rows.iter().filter_map(dots).collect();
    if dots.is_empty() {
        return Ok(());
    }
    chart::dots(
        &path("svg"),
        Scale::Steps,
        "environment steps to the first 200 of 200: median, range and each seed that got there",
        &dots,
    )
}

/// Seconds of training until the first evaluation without a failure, by the clock.
fn seconds(row: &Row) -> Option<f64> {
    row.group.median(|cell| Some(cell.outcome.first_perfect?.training.wall))
}

fn processor(row: &Row) -> Option<f64> {
    row.group.median(|cell| cell.outcome.first_perfect?.training.processor)
}

fn steps(row: &Row) -> Option<f64> {
    row.group.median(|cell| Some(cell.outcome.first_perfect?.step as f64))
}

/// Steps of the seeds that got there, sorted.
fn reached(row: &Row) -> Vec<f64> {
    let mut steps: Vec<f64> = row.group.done().filter_map(|c| Some(c.outcome.first_perfect?.step as f64)).collect();
    steps.sort_by(f64::total_cmp);
    steps
}

fn markdown(contest: &Contest, rows: &[Row]) -> String {
    let mut text = String::from("# Training time (Table 2 of the paper), and steps to the first 200 of 200\n\n");
    text += &contest.about(rows);
    text += "\nA seed gets there at the first of its periodic evaluations in which no episode fails. Medians over seeds; `never` where half of\n\
             the seeds or more did not get there within the budget. Times are training alone, by the clock and of the processor; the paper's are\n\
             whole trainings of its fixed number of episodes, on a 2.8 GHz quad core with a GTX or RTX 1080.\n\n";
    let mut table = Table::new(&[
        "task",
        "contender",
        ">paper",
        ">seeds that got there",
        ">steps",
        "range",
        ">time",
        ">processor",
        ">steps per s",
        ">budget",
    ]);
    for row in rows {
        let group = &row.group;
        let minutes = paper(&group.task).and_then(|p| p.minutes(row.method));
        let mut cells = vec![
            short(&group.task).to_owned(),
            row.method.title().to_owned(),
            minutes.map_or("–".into(), |m| duration(60.0 * m)),
        ];
        let Some(median) = steps(row) else {
            cells.push(MISSING.to_owned());
            cells.extend(vec![String::new(); 6]);
            table.row(&cells);
            continue;
        };
        let reached = reached(row);
        let range = match (reached.first(), reached.last()) {
            (Some(&low), Some(&high)) => format!("{} to {}", count(low), count(high)),
            _ => String::new(),
        };
        let rate = group.median(|cell| Some(cell.outcome.steps as f64 / cell.outcome.training.wall.max(1e-9)));
        let budget = group.done().find_map(|cell| cell.config["budget"].as_f64());
        cells.extend([
            format!("{}/{}", group.perfect(), group.done().count()),
            count(median),
            range,
            seconds(row).map_or_else(String::new, duration),
            processor(row).map_or_else(String::new, duration),
            rate.map_or_else(String::new, count),
            budget.map_or_else(String::new, count),
        ]);
        table.row(&cells);
    }
    text + &table.finish()
}

fn object(row: &Row) -> Value {
    let finite = |value: Option<f64>| value.filter(|v| v.is_finite());
    json!({
        "task": row.group.task,
        "contender": row.method.key(),
        "paper_minutes": paper(&row.group.task).and_then(|p| p.minutes(row.method)),
        "seeds_finished": row.group.done().count(),
        "seeds_perfect": row.group.perfect(),
        "steps_median": finite(steps(row)),
        "seconds_median": finite(seconds(row)),
        "processor_seconds_median": finite(processor(row)),
        "steps": reached(row),
    })
}

fn csv(lines: &[Value]) -> Result<Vec<u8>, Failure> {
    let failed = |e: csv::Error| Failure::running(e);
    let mut table = csv::Writer::from_writer(vec![]);
    let columns = [
        "task",
        "contender",
        "paper_minutes",
        "seeds_finished",
        "seeds_perfect",
        "steps_median",
        "seconds_median",
        "processor_seconds_median",
    ];
    table.write_record(columns).map_err(failed)?;
    for line in lines {
        let cell = |column: &&str| match &line[*column] {
            Value::Null => String::new(),
            Value::String(text) => text.clone(),
            other => other.to_string(),
        };
        table.write_record(columns.iter().map(cell)).map_err(failed)?;
    }
    table.into_inner().map_err(|e| Failure::running(e.error()))
}

fn dots(row: &Row) -> Option<Dots> {
    let values = reached(row);
    let interval = Interval { low: *values.first()?, high: *values.last()? };
    let middle = steps(row).filter(|m| m.is_finite()).unwrap_or(interval.high);
    let label = format!("{}  {}", short(&row.group.task), row.method.title());
    Some(Dots { label, colour: row.method as usize, middle, interval, values })
}
