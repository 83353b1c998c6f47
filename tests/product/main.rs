//! The embedded product: frontier, rounds, reward, shaping, ε-moves, Algorithm 1; on random automata and finite MDPs.

mod ep_mdp;
mod finite;
mod frontier;
mod shaping;
