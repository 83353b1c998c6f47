//! Trains a shipped task by its `fast` recipe with one number changed, and judges the policy on starts that training has not seen.
//!
//! `cargo run --release --example train_a_task`

use ltl_rover::eval::evaluate;
use ltl_rover::task::{Setup, Task};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let task = Task::parse(include_str!("../specs/ball_pass_b1.toml"), "ball_pass_b1")?;
    let changes = ["learner.n_step=12".parse()?];
    // Without an automaton in the HOA format the formula is translated.
    let setup = Setup::open(task, "fast", &changes, None)?;
    println!("{}: {} automaton states", setup.task().file().specification.ltl, setup.automaton().states().count());

    let mut run = setup.run(1);
    while !run.finished() {
        run.advance();
    }
    println!("every run of an evaluation succeeded first after {:?} steps", run.first_perfect_step());

    let mut policy = setup.learner(0);
    policy.load_policy(&run.policy())?;
    let judged = evaluate(&mut setup.rollout(1000), &mut policy, 200, 1000);
    println!(
        "{} of {} runs succeed, 95 % interval [{:.3}, {:.3}]",
        judged.successes, judged.runs, judged.ci95.low, judged.ci95.high
    );
    match judged.success_rate > 0.9 {
        true => Ok(()),
        false => Err("not learned".into()),
    }
}
