//! The embedded product MDP, its reward and its shaping ([Cai et al. 2021](crate::bib::Cai2021), sections IV and V).
//!
//! [`EpMdp`] walks environment and automaton together (Definition 4). A [`Reward`] judges each [`ProductStep`] and gives a
//! [`Payoff`]; it has no memory of its own, since T and T_Φ belong to the state. [`ProductStep::read`] and [`ProductStep::jump`] are
//! the pure successor functions, for replaying a transition from another automaton state. [`run`] is Algorithm 1.
//!
//! **\[D1\] When a letter is read.** The print reads L(s) of the state that is left. Here, as in the textbook product
//! ([Baier & Katoen 2008](crate::bib::BaierKatoen2008), chapter 10), [`EpMdp::reset`] reads L(s_0) and each step reads L(s') of the
//! state that is reached: the same word, every letter once, and the reward falls on the step that earned it.

mod ep_mdp;
mod letters;
mod reward;
mod rounds;
mod run;
mod shaping;
mod step;

pub use ep_mdp::{EpMdp, ProductStart, Snapshot, SnapshotError, Start};
pub use letters::{LetterMap, LetterMapError, Renaming};
pub use reward::{LdgbaReward, Payoff, Reward, RewardError, RewardParts, RewardSettings};
pub use rounds::Rounds;
pub use run::{Chosen, Run, RunEnd, RunState, product_trace_hash, run, run_with};
pub use shaping::Shaping;
pub use step::{Move, MoveKind, ProductStep};
