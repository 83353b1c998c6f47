//! A map with its picture, regions and trails as one SVG file that needs no other.

use crate::cli::curves::COLOURS;
use crate::env::{Region, Scene, Shape, YAxis};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use plotters::style::RGBColor;
use std::fmt::Write;

/// Width of the drawing in pixels.
const WIDTH: f32 = 960.0;

/// The pictures of the shipped maps.
const PICTURES: [(&str, &[u8]); 2] = [
    ("melas.webp", include_bytes!("../../../assets/melas.webp")),
    ("victoria.webp", include_bytes!("../../../assets/victoria.webp")),
];

/// The way of one episode.
#[derive(Clone, PartialEq, Debug)]
pub struct Trail {
    /// Places (x, y) in the map's unit, the start first.
    pub points: Vec<[f32; 2]>,
    /// Places of visits to accepting sets of the frontier, in order.
    pub visits: Vec<[f32; 2]>,
}

/// The drawing of `scene` with `trails`, as SVG.
pub fn draw(scene: &Scene, title: &str, trails: &[Trail]) -> String {
    let view = View::of(scene);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH:.0} {:.0}\" font-family=\"sans-serif\" font-size=\"13\">\n\
         <title>{}</title>\n<rect width=\"100%\" height=\"100%\" fill=\"#d9d4cc\"/>\n",
        view.height,
        escaped(title)
    );
    svg += "<defs><pattern id=\"unsafe\" width=\"8\" height=\"8\" patternUnits=\"userSpaceOnUse\" patternTransform=\"rotate(45)\">\
            <line x1=\"0\" y1=\"0\" x2=\"0\" y2=\"8\" stroke=\"#000\" stroke-opacity=\"0.45\" stroke-width=\"2\"/></pattern></defs>\n";
    let picture = scene.picture.as_deref().and_then(|name| PICTURES.iter().find(|(known, _)| *known == name));
    if let Some((_, bytes)) = picture {
        let data = STANDARD.encode(bytes);
        let _ = writeln!(
            svg,
            "<image width=\"{WIDTH:.0}\" height=\"{:.0}\" preserveAspectRatio=\"none\" href=\"data:image/webp;base64,{data}\"/>",
            view.height
        );
    }
    for region in &scene.regions {
        view.region(&mut svg, region, scene.hazard == Some(region.proposition));
    }
    for (i, trail) in trails.iter().enumerate() {
        view.trail(&mut svg, trail, i);
    }
    svg + "</svg>\n"
}

/// From the map's unit to pixels.
struct View {
    left: f32,
    edge: f32,
    up: bool,
    scale: f32,
    height: f32,
}

impl View {
    fn of(scene: &Scene) -> View {
        let ([left, right], [bottom, top]) = (scene.ground.x, scene.ground.y);
        let scale = WIDTH / (right - left);
        let up = scene.ground.y_axis == YAxis::Up;
        View { left, edge: if up { top } else { bottom }, up, scale, height: scale * (top - bottom) }
    }

    fn place(&self, [x, y]: [f32; 2]) -> [f32; 2] {
        [self.scale * (x - self.left), self.scale * if self.up { self.edge - y } else { y - self.edge }]
    }

    fn points(&self, points: &[[f32; 2]]) -> String {
        let place = |p: &[f32; 2]| {
            let [x, y] = self.place(*p);
            format!("{x:.1},{y:.1}")
        };
        points.iter().map(place).collect::<Vec<_>>().join(" ")
    }

    fn region(&self, svg: &mut String, region: &Region, hazard: bool) {
        let style = if hazard {
            "fill=\"url(#unsafe)\" stroke=\"#000\" stroke-opacity=\"0.6\"".to_owned()
        } else {
            let colour = hex(COLOURS[region.proposition % COLOURS.len()]);
            format!("fill=\"{colour}\" fill-opacity=\"0.3\" stroke=\"{colour}\" stroke-width=\"2\"")
        };
        let name = escaped(&region.name);
        let _ = match &region.shape {
            Shape::Disc { centre, radius } => {
                let [x, y] = self.place(*centre);
                let radius = self.scale * (radius + region.margin);
                writeln!(svg, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius:.1}\" {style}><title>{name}</title></circle>")
            }
            Shape::Polygon { points } => {
                let points = self.points(points);
                writeln!(svg, "<polygon points=\"{points}\" fill-rule=\"evenodd\" {style}><title>{name}</title></polygon>")
            }
            Shape::Band { .. } => Ok(()),
            Shape::Cells { cell, runs } => runs.iter().try_for_each(|&[row, column, length]| {
                let [x, y] = [column as f32 * cell[0], row as f32 * cell[1]].map(|v| v * self.scale);
                let [width, height] = [length as f32 * cell[0], cell[1]].map(|v| v * self.scale);
                writeln!(
                    svg,
                    "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{width:.1}\" height=\"{height:.1}\" {style} stroke-width=\"0\"/>"
                )
            }),
        };
    }

    fn trail(&self, svg: &mut String, trail: &Trail, index: usize) {
        // Yellow and sky blue stand out from the ground; the casing keeps them apart from it for every kind of colour vision.
        let colour = ["#ffe14d", "#7fd4ff", "#ffb3e6", "#b6ff9e"][index % 4];
        let points = self.points(&trail.points);
        let dashes = if index.is_multiple_of(2) { "" } else { " stroke-dasharray=\"9 3\"" };
        let line = "fill=\"none\" stroke-linejoin=\"round\"";
        let _ =
            writeln!(svg, "<polyline points=\"{points}\" {line} stroke=\"#000\" stroke-opacity=\"0.7\" stroke-width=\"4.5\"/>");
        let _ = writeln!(svg, "<polyline points=\"{points}\" {line} stroke=\"{colour}\" stroke-width=\"2.2\"{dashes}/>");
        let [x, y] = self.place(trail.points[0]);
        let _ =
            writeln!(svg, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"7\" fill=\"{colour}\" stroke=\"#000\" stroke-width=\"2\"/>");
        for (k, visit) in trail.visits.iter().enumerate() {
            let [x, y] = self.place(*visit);
            let _ = writeln!(
                svg,
                "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"9\" fill=\"{colour}\" stroke=\"#000\"/>\
                 <text x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"middle\" font-size=\"11\">{}</text>",
                y + 4.0,
                k + 1
            );
        }
    }
}

fn hex(RGBColor(r, g, b): RGBColor) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::env::{Environment, Islands};

    #[test]
    fn the_drawing_has_the_picture_all_regions_and_all_trails() {
        let rover = crate::env::Rover::shipped("melas").unwrap();
        let scene = rover.scene();
        let trail = Trail { points: vec![[0.0, 0.0], [456.0, 330.6]], visits: vec![[228.0, 165.3]] };
        let svg = draw(&scene, "a < b", &[trail.clone(), trail]);
        assert_eq!(svg.matches("<image ").count(), 1);
        assert_eq!(svg.matches("<title>").count(), 1 + scene.regions.len());
        assert_eq!(svg.matches("<polyline ").count(), 4);
        assert!(svg.contains("points=\"0.0,0.0 960.0,696.0\"") && svg.contains("a &lt; b"));
        assert!(svg.matches("url(#unsafe)").count() >= 1);
    }

    #[test]
    fn where_y_grows_upwards_the_picture_is_turned() {
        let scene = Islands::new(crate::env::Current::None).scene();
        let view = View::of(&scene);
        assert_eq!(view.place([0.0, 10.0]), [0.0, 0.0]);
        assert_eq!(view.place([10.0, 0.0]), [960.0, 960.0]);
    }
}
