//! No start on the shipped maps is hopeless: a controller that looks far enough never has to touch unsafe ground.

use crate::shipped;

/// Directions that are tried, and places looked at along the longest step.
const DIRECTIONS: usize = 64;
const PLACES: usize = 20;

/// From the centre of each free cell some direction is safe at every distance that a step can have. The step ends on a free cell again,
/// so that a controller with these directions stays safe for ever, but for what lies between centres.
#[test]
fn from_every_free_cell_some_direction_is_safe_at_every_distance() {
    for name in ["victoria", "melas"] {
        let map = shipped(name);
        let hazard = map.hazard.expect("both maps have unsafe ground");
        let [columns, rows] = map.grid.size();
        let cell = map.grid.cell();
        let safe = |x: f32, y: f32| !map.grid.labels(x, y).holds(hazard);
        let directions: Vec<[f32; 2]> = (0..DIRECTIONS)
            .map(|k| libm::sincosf(k as f32 / DIRECTIONS as f32 * std::f32::consts::TAU))
            .map(|(sin, cos)| [cos, sin])
            .collect();
        // The direction that was open from the cell before, which mostly is here as well.
        let (mut free, mut last) = (0_u32, 0);
        for row in 0..rows {
            for column in 0..columns {
                let (x, y) = ((column as f32 + 0.5) * cell[0], (row as f32 + 0.5) * cell[1]);
                if !safe(x, y) {
                    continue;
                }
                free += 1;
                // A step that would leave the map ends on its border.
                let at = |[dx, dy]: [f32; 2], k: usize| {
                    let distance = map.reach * k as f32 / PLACES as f32;
                    safe((x + distance * dx).clamp(0.0, map.size[0]), (y + distance * dy).clamp(0.0, map.size[1]))
                };
                // The far end first: it is what touches most often.
                let open = |i: &usize| (1..=PLACES).rev().all(|k| at(directions[*i], k));
                let found = (last..last + DIRECTIONS).map(|i| i % DIRECTIONS).find(open);
                last = found.unwrap_or_else(|| panic!("{name}: no way out of ({x}, {y})"));
            }
        }
        assert!(free > 100_000, "{name} has {free} free cells");
    }
}
