//! The names that task files use for parts: the only place where a name becomes an environment.

use crate::env::{BallPass, CartPole, Environment};

/// The environments there are, by name.
const ENVIRONMENTS: &[(&str, fn() -> Box<dyn Environment>)] =
    &[("ball_pass", || Box::new(BallPass::new())), ("cart_pole", || Box::new(CartPole::new()))];

/// The environment called `name`.
pub fn environment(name: &str) -> Option<Box<dyn Environment>> {
    ENVIRONMENTS.iter().find(|(known, _)| *known == name).map(|(_, make)| make())
}

/// The names of all environments.
pub fn environments() -> impl Iterator<Item = &'static str> + Clone {
    ENVIRONMENTS.iter().map(|(name, _)| *name)
}
