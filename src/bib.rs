//! The papers the project builds on, as items that doc comments link to.
#![allow(non_snake_case)]

/// M. Cai, M. Hasanbeig, S. Xiao, A. Abate, Z. Kan: *Modular Deep Reinforcement Learning for Continuous Motion Planning with
/// Temporal Logic*, IEEE Robotics and Automation Letters 6(4), 2021.
pub mod Cai2021 {}
/// C. Baier, J.-P. Katoen: *Principles of Model Checking*, MIT Press, 2008.
pub mod BaierKatoen2008 {}
/// T. Babiak, F. Blahoudek, A. Duret-Lutz, J. Klein, J. Křetínský, D. Müller, D. Parker, J. Strejček: *The Hanoi Omega-Automata
/// Format*, CAV 2015; format version 1.
pub mod HOA2015 {}
/// S. Sickert, J. Esparza, S. Jaax, J. Křetínský: *Limit-Deterministic Büchi Automata for Linear Temporal Logic*, CAV 2016.
pub mod Sickert2016 {}
/// J. Esparza, J. Křetínský, S. Sickert: *A Unified Translation of Linear Temporal Logic to ω-Automata*, J. ACM 67(6), 2020
/// (LICS 2018).
pub mod Esparza2020 {}
/// E. M. Hahn, M. Perez, S. Schewe, F. Somenzi, A. Trivedi, D. Wojtczak: *Good-for-MDPs Automata for Probabilistic Analysis and
/// Reinforcement Learning*, TACAS 2020.
pub mod Hahn2020 {}
/// A. K. Bozkurt, Y. Wang, M. M. Zavlanos, M. Pajic: *Control Synthesis from Linear Temporal Logic Specifications using
/// Model-Free Reinforcement Learning*, ICRA 2020.
pub mod Bozkurt2020 {}
/// T. P. Lillicrap, J. J. Hunt, A. Pritzel, N. Heess, T. Erez, Y. Tassa, D. Silver, D. Wierstra: *Continuous Control with Deep
/// Reinforcement Learning*, ICLR 2016.
pub mod Lillicrap2016 {}
/// A. Y. Ng, D. Harada, S. Russell: *Policy Invariance under Reward Transformations: Theory and Application to Reward Shaping*,
/// ICML 1999.
pub mod Ng1999 {}
/// D. P. Kingma, J. Ba: *Adam: A Method for Stochastic Optimization*, ICLR 2015.
pub mod KingmaBa2015 {}
/// S. Fujimoto, H. van Hoof, D. Meger: *Addressing Function Approximation Error in Actor-Critic Methods*, ICML 2018.
pub mod Fujimoto2018 {}
/// R. Toro Icarte, T. Q. Klassen, R. Valenzano, S. A. McIlraith: *Reward Machines: Exploiting Reward Function Structure in
/// Reinforcement Learning*, JAIR 73, 2022 (counterfactual experiences).
pub mod ToroIcarte2022 {}
/// A. G. Barto, R. S. Sutton, C. W. Anderson: *Neuronlike Adaptive Elements That Can Solve Difficult Learning Control Problems*,
/// IEEE Transactions on Systems, Man, and Cybernetics, 1983.
pub mod Barto1983 {}
/// C. J. Clopper, E. S. Pearson: *The Use of Confidence or Fiducial Limits Illustrated in the Case of the Binomial*, Biometrika
/// 26(4), 1934.
pub mod ClopperPearson1934 {}
/// R. Agarwal, M. Schwarzer, P. S. Castro, A. Courville, M. G. Bellemare: *Deep Reinforcement Learning at the Edge of the
/// Statistical Precipice*, NeurIPS 2021.
pub mod Agarwal2021 {}
/// J. L. Ba, J. R. Kiros, G. E. Hinton: *Layer Normalization*, arXiv:1607.06450, 2016.
pub mod Ba2016 {}
/// P. J. Ball, L. Smith, I. Kostrikov, S. Levine: *Efficient Online Reinforcement Learning with Offline Data*, ICML 2023.
pub mod Ball2023 {}
/// W. Dabney, G. Ostrovski, A. Barreto: *Temporally-Extended ε-Greedy Exploration*, ICLR 2021.
pub mod Dabney2021 {}
/// M. Tancik, P. P. Srinivasan, B. Mildenhall, S. Fridovich-Keil, N. Raghavan, U. Singhal, R. Ramamoorthi, J. T. Barron, R. Ng:
/// *Fourier Features Let Networks Learn High Frequency Functions in Low Dimensional Domains*, NeurIPS 2020.
pub mod Tancik2020 {}
/// G. Yang, A. Ajay, P. Agrawal: *Overcoming the Spectral Bias of Neural Value Approximation*, ICLR 2022.
pub mod Yang2022 {}
/// A. Barreto, W. Dabney, R. Munos, J. J. Hunt, T. Schaul, H. van Hasselt, D. Silver: *Successor Features for Transfer in
/// Reinforcement Learning*, NeurIPS 2017 (generalised policy improvement).
pub mod Barreto2017 {}
/// M. Andrychowicz, F. Wolski, A. Ray, J. Schneider, R. Fong, P. Welinder, B. McGrew, J. Tobin, P. Abbeel, W. Zaremba: *Hindsight
/// Experience Replay*, NeurIPS 2017.
pub mod Andrychowicz2017 {}
/// J. Tobin, R. Fong, A. Ray, J. Schneider, W. Zaremba, P. Abbeel: *Domain Randomization for Transferring Deep Neural Networks from
/// Simulation to the Real World*, IROS 2017.
pub mod Tobin2017 {}
/// R. S. Sutton, A. G. Barto: *Reinforcement Learning: An Introduction*, second edition, MIT Press, 2018.
pub mod SuttonBarto2018 {}
/// S. Haddad, B. Monmege: *Interval Iteration Algorithm for MDPs and IMDPs*, Theoretical Computer Science 735, 2018.
pub mod HaddadMonmege2018 {}
