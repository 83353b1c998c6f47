//! The embedded product MDP, its reward and its shaping ([Cai et al. 2021](crate::bib::Cai2021), sections IV and V).
