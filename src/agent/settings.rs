//! The numbers of modular DDPG; the defaults are the paper's and, where it is silent, those of the DDPG paper.

use super::exploration::ExplorationSettings;
use super::schedule::Schedule;
use crate::nn::{Critics, LayerNorm};
use serde::{Deserialize, Serialize};

/// Which embedded states share one pair of networks.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Default, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "cli", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum ModuleMap {
    /// One module per automaton state: modular DDPG (Algorithm 2 of [Cai et al. 2021](crate::bib::Cai2021)).
    #[default]
    PerState,
    /// One module per pair (q, T) that can be reached.
    PerEmbedded,
    /// One module per accepting set F_j, which learns to visit F_j next and sees q one-hot; of the modules of T the one that promises
    /// the most is in charge ([`Modules`](super::Modules) tells why that is sound).
    PerSet,
    /// One module for all, which sees q one-hot as well: standard DDPG, the paper's baseline.
    One,
}

/// Whose networks an update changes.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Default, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "cli", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum UpdatedModule {
    /// Those of the module in charge of q_t, the state that was just left (Algorithm 2, lines 14–18).
    #[default]
    Current,
    /// Those of a module drawn uniformly from the ones with enough samples: modules that are seldom in charge learn as much.
    Random,
}

/// Samples of the same transition under other embedded states (counterfactual experiences,
/// [Toro Icarte et al. 2022](crate::bib::ToroIcarte2022)).
#[derive(Clone, Copy, PartialEq, Eq, Hash, Default, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "cli", derive(schemars::JsonSchema))]
#[serde(default, deny_unknown_fields)]
pub struct CounterfactualSettings {
    /// How many other embedded states, drawn anew, each recorded segment is replayed from; 0 switches it off.
    pub samples: u32,
}

/// Noise on the target actor's action ([Fujimoto et al. 2018](crate::bib::Fujimoto2018), section 5.3).
#[derive(Clone, Copy, PartialEq, Default, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "cli", derive(schemars::JsonSchema))]
#[serde(default, deny_unknown_fields)]
pub struct TargetSmoothing {
    /// Deviation of the noise, in units of the action range; 0 switches it off (TD3 takes 0.2).
    pub sigma: f32,
    /// The noise is clipped to ± this (TD3 takes 0.5).
    pub clip: f32,
}

/// Everything that is chosen about a [`ModularDdpg`](super::ModularDdpg).
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "cli", derive(schemars::JsonSchema))]
#[serde(default, deny_unknown_fields)]
pub struct LearnerSettings {
    /// Which embedded states share networks.
    pub modules: ModuleMap,
    /// Width of each hidden layer of actor and critic.
    pub hidden: Vec<usize>,
    /// One critic per module, or two whose smaller value counts.
    pub critics: Critics,
    /// Which networks normalise their hidden layers.
    pub layer_norm: LayerNorm,
    /// Octaves of Fourier features that stand behind the observation in a network's input
    /// ([`Encoder::with_fourier_features`](super::Encoder::with_fourier_features)); 0 for none.
    pub fourier_octaves: u32,
    /// Learning rate of the actors.
    pub actor_rate: Schedule,
    /// Learning rate of the critics.
    pub critic_rate: Schedule,
    /// τ of the soft update of the targets.
    pub tau: f32,
    /// N, samples per update.
    pub batch: usize,
    /// Samples that each module's replay keeps; the oldest is overwritten.
    pub replay: usize,
    /// Steps in a return: y = Σ R'·Πγ + Πγ·Q'; 1 is Algorithm 2.
    pub n_step: usize,
    /// Updates after each step.
    pub updates_per_step: u32,
    /// Environment steps from one round of updates to the next; 1 is Algorithm 2.
    pub update_every: u32,
    /// Whose networks an update changes.
    pub updated_module: UpdatedModule,
    /// Critic updates for each update of the actor and the targets; 1 is Algorithm 2.
    pub policy_delay: u32,
    /// Weight of the mean square of what the actor's tanh is taken of, in the actor's loss: it keeps tanh from saturating, where the critic
    /// can turn the actor no more ([Andrychowicz et al. 2017](crate::bib::Andrychowicz2017), appendix A); 0 switches it off. In
    /// units of scaled rewards.
    pub saturation_penalty: f32,
    /// Noise on the target actor's action.
    pub target_smoothing: TargetSmoothing,
    /// What rewards are multiplied by inside the learner; reported returns stay in the paper's units.
    pub reward_scale: f32,
    /// How the learner explores.
    pub exploration: ExplorationSettings,
    /// Samples of the same transition under other embedded states.
    pub counterfactual: CounterfactualSettings,
}

impl Default for LearnerSettings {
    /// Algorithm 2 of [Cai et al. 2021](crate::bib::Cai2021); sizes and rates, which it leaves open, from
    /// [Lillicrap et al. 2016](crate::bib::Lillicrap2016), section 7: rates 1e-4 and 1e-3, τ = 0.001, batch 64, replay 10^6.
    fn default() -> LearnerSettings {
        LearnerSettings {
            modules: ModuleMap::PerState,
            hidden: vec![64, 64],
            critics: Critics::One,
            layer_norm: LayerNorm::None,
            fourier_octaves: 0,
            actor_rate: Schedule::Constant(1e-4),
            critic_rate: Schedule::Constant(1e-3),
            tau: 1e-3,
            batch: 64,
            replay: 1_000_000,
            n_step: 1,
            updates_per_step: 1,
            update_every: 1,
            updated_module: UpdatedModule::Current,
            policy_delay: 1,
            saturation_penalty: 0.0,
            target_smoothing: TargetSmoothing::default(),
            reward_scale: 1.0,
            exploration: ExplorationSettings::default(),
            counterfactual: CounterfactualSettings::default(),
        }
    }
}
