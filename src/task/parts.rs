//! The names that task files use for parts: the only place where a name becomes an environment.

use super::error::did_you_mean;
use super::file::EnvironmentSection;
use crate::env::map::RoverMap;
use crate::env::{BallPass, CartPole, Environment, Islands, Rover};
use std::sync::Arc;

/// The names of all environments.
pub const ENVIRONMENTS: [&str; 4] = ["ball_pass", "cart_pole", "islands", "rover"];

/// What is wrong with a task's choice of an environment: the key, a sentence, and advice.
pub(super) struct NoEnvironment {
    pub key: &'static str,
    pub message: String,
    pub help: Option<String>,
}

/// The environment that a section describes; `own` is the map that was read from the file it names.
pub(super) fn environment(
    section: &EnvironmentSection,
    own: Option<&Arc<RoverMap>>,
) -> Result<Box<dyn Environment>, NoEnvironment> {
    let refuse = |key, message, help| Err(NoEnvironment { key, message, help });
    if section.map.is_some() && section.name != "rover" {
        return refuse("map", format!("only `rover` has a map, not `{}`", section.name), None);
    }
    if section.current.is_some() && section.name != "islands" {
        return refuse("current", format!("only `islands` has a current, not `{}`", section.name), None);
    }
    match section.name.as_str() {
        "ball_pass" => Ok(Box::new(BallPass::new())),
        "cart_pole" => Ok(Box::new(CartPole::new())),
        "islands" => Ok(Box::new(Islands::new(section.current.unwrap_or_default()))),
        "rover" => rover(section.map.as_deref(), own),
        wanted => {
            let message = format!("there is no environment `{wanted}`; known are `{}`", ENVIRONMENTS.join("`, `"));
            refuse("name", message, did_you_mean(wanted, ENVIRONMENTS))
        }
    }
}

fn rover(map: Option<&str>, own: Option<&Arc<RoverMap>>) -> Result<Box<dyn Environment>, NoEnvironment> {
    let shipped: Vec<&str> = RoverMap::shipped_names().collect();
    let known = shipped.join("`, `");
    let Some(wanted) = map else {
        let message = "`rover` needs a map".to_owned();
        let help = Some(format!("add `map = \"NAME\"` with one of `{known}`, or a map file"));
        return Err(NoEnvironment { key: "name", message, help });
    };
    let rover = Rover::shipped(wanted).or_else(|| own.map(|map| Rover::new(map.clone())));
    let rover = rover.map(|rover| Box::new(rover) as Box<dyn Environment>);
    rover.ok_or_else(|| {
        let message = format!("the map `{wanted}` is not among the shipped ones, `{known}`, and no file of that name was given");
        NoEnvironment { key: "map", message, help: did_you_mean(wanted, shipped) }
    })
}
