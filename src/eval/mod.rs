//! Evaluation: greedy episodes and the statistics of many.
