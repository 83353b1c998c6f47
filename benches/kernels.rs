//! Times the kernels against the bound of the processor.
use ltl_rover::nn::fused::{Fused, Kernel};
use ltl_rover::nn::{NetworkShape, workload::*};
use ltl_rover::rng::{Purpose, Rng};
use std::time::Instant;
fn main() {
    let mut best = 0.0f64;
    for _ in 0..20 {
        let t = Instant::now();
        let f = peak(Kernel::fastest(), 1_000_000);
        best = best.max(f / t.elapsed().as_secs_f64());
    }
    println!("peak {:.1} GFLOP/s {}", best / 1e9, Kernel::fastest().name());
    for (h, b) in [(64, 64), (128, 128), (256, 128)] {
        let shape = NetworkShape::new(8, 2, &[h, h]);
        for k in [Kernel::fastest(), Kernel::PORTABLE] {
            let mut w = Workload::new(Box::new(Fused::with_kernel(&shape, &mut Rng::new(1, Purpose::Initialisation), k)), b, 1);
            let n = if h == 64 { 2000 } else { 200 };
            let mut times: Vec<f64> = (0..9)
                .map(|_| {
                    let t = Instant::now();
                    for _ in 0..n {
                        w.update();
                    }
                    t.elapsed().as_secs_f64() / n as f64 * 1e6
                })
                .collect();
            times.sort_by(f64::total_cmp);
            let bound = operations(&shape, b) / best * 1e6;
            let t = Instant::now();
            for _ in 0..100000 {
                w.act();
            }
            let act = t.elapsed().as_secs_f64() / 100000.0 * 1e6;
            println!(
                "{h} {b} {:12} median {:.1} best {:.1} bound {:.1} ratio {:.2} / {:.2}  act {:.3}",
                k.name(),
                times[4],
                times[0],
                bound,
                times[4] / bound,
                times[0] / bound,
                act
            );
        }
    }
}
