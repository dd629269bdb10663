//! Mass properties before and after, over a pale picture: the ellipsoid of the same inertia, its
//! axes and the centre of mass. As in Spin-It, ACM TOG 33(4), 2014, figures 4 and 5.

use rayon::prelude::*;

use super::figure::{Picture, Role};
use super::subject::Subject;
use super::viewpoint::Viewpoint;
use crate::base::numbers::{measured, quantity};
use crate::base::watch::Watch;
use crate::draw::{
    Anchor, BODY, Camera, Drawing, Drawn, INK, Item, PAPER, Paint, PictureError, Projection, Scene,
    Spot, Stroke, VOID, hex, render, short,
};
use crate::geom::{Matrix, Point, Vector};
use crate::goal::GoalKind;
use crate::mass::Body;
use crate::sheet::Checklist;
use crate::verify::Figures;

/// Opacity of the pale picture.
const PALE: f64 = 0.35;

/// Height of words, pixels: 10 points at half the width of an A4 page.
const TEXT_PX: f64 = 28.0;

/// Radius of the symbol of a centre of mass, pixels.
const CENTER_PX: f64 = 13.0;

/// Ratio of a squared semi-axis to the second moment per mass. A solid ellipsoid with semi-axes
/// a, b, c has the second moments m a²/5, m b²/5, m c²/5 about its centre.
const ELLIPSOID_RATIO: f64 = 5.0;

/// The colour of the ellipsoid: blue.
const ELLIPSOID: &str = "#0072b2";

/// Height of words on the picture of the test, pixels: 10 points at 72 mm of width.
const TEST_TEXT_PX: f64 = 35.0;

/// Distance of the height of the centre from it, pixels.
const HEIGHT_ASIDE_PX: f64 = 60.0;

/// A state of the object: filled solid, or as made.
struct State<'a> {
    file: &'static str,
    name: &'static str,
    role: Role,
    body: &'a Figures,
    scene: Scene<'a>,
}

/// Draws the pictures before and after, seen from the side.
pub(super) fn pictures(
    sheet: &Checklist,
    subject: &Subject,
    watch: &Watch,
) -> Result<Vec<Picture>, PictureError> {
    let (outer, voids) = (subject.shells.outer_mesh(), subject.shells.inner_mesh());
    let frame = subject.aim.frame();
    let view = Viewpoint::of(&outer, &frame);
    let side = Camera {
        margin_ratio: [0.14; 2],
        ..Camera::new(view.cut.normal, frame.axis())
    };
    let cut = Some(view.cut);
    let states = [
        State {
            file: "pictures/inertia-before.svg",
            name: "Solid",
            role: Role::Inertia,
            body: &sheet.solid,
            scene: Scene {
                items: vec![Item::new(&outer, BODY)],
                cut: None,
            },
        },
        State {
            file: "pictures/inertia-after.svg",
            name: "As made",
            role: Role::Made,
            body: &sheet.assembly,
            scene: Scene {
                items: vec![Item::new(&outer, BODY), Item::new(&voids, VOID)],
                cut,
            },
        },
    ];
    let draw = |state: &State| {
        watch.check()?;
        picture(state, &side, sheet)
    };
    let (drawn, test) = rayon::join(
        || states.par_iter().map(draw).collect::<Result<Vec<_>, _>>(),
        || test_picture(&states[1], &side, sheet),
    );
    let mut drawn = drawn?;
    drawn.push(test?);
    Ok(drawn)
}

/// Draws what the test looks for: the centre of mass, its height, and the axis.
fn test_picture(state: &State, side: &Camera, sheet: &Checklist) -> Result<Picture, PictureError> {
    let projection = Projection::of(&state.scene, side, 1);
    let mut drawing = Drawing::new(side.size_px, TEST_TEXT_PX);
    drawing.picture(&render(&state.scene, side).to_png()?, side.size_px, PALE);
    draw_goal_axis(&mut drawing, &projection, sheet);
    let center = Point::from(state.body.center_mm);
    let at = projection.at(&center);
    if matches!(sheet.goal.aim.kind, GoalKind::Top | GoalKind::Stand) {
        let height_mm = state.body.center_height_mm;
        let [_, ground] = projection.at(&(center - projection.axes[1] * height_mm));
        let words = measured(height_mm, "mm");
        let foot = [at[0] + HEIGHT_ASIDE_PX, ground];
        drawing.dimension([[foot[0], at[1]], foot], [HEIGHT_ASIDE_PX, 0.0], &words);
    }
    draw_center(&mut drawing, at);
    Ok(Picture {
        file: "pictures/test.svg".to_owned(),
        role: Role::Test,
        caption: "The quartered disc is the centre of mass, the dash-dotted line the axis."
            .to_owned(),
        alt: "The finished object from the side, cut open, with its centre of mass and the axis."
            .to_owned(),
        drawn: Drawn::Svg(drawing),
    })
}

fn picture(state: &State, side: &Camera, sheet: &Checklist) -> Result<Picture, PictureError> {
    let projection = Projection::of(&state.scene, side, 1);
    let mut drawing = Drawing::new(side.size_px, TEXT_PX);
    drawing.picture(&render(&state.scene, side).to_png()?, side.size_px, PALE);
    let body = Body {
        mass_g: state.body.mass_g,
        center: Point::from(state.body.center_mm),
        inertia_g_mm2: Matrix::from_fn(|row, column| state.body.inertia_g_mm2[row][column]),
    };
    draw_goal_axis(&mut drawing, &projection, sheet);
    draw_ellipsoid(&mut drawing, &projection, &body);
    draw_principal_axes(&mut drawing, &projection, &body);
    draw_center(&mut drawing, projection.at(&body.center));
    drawing.text([12.0, TEXT_PX], Anchor::Start, state.name);
    Ok(Picture {
        file: state.file.to_owned(),
        role: state.role,
        caption: caption(state, sheet),
        alt: format!(
            "{}: side view with its inertia ellipsoid, principal axes and centre of mass against the axis of the goal.",
            state.name
        ),
        drawn: Drawn::Svg(drawing),
    })
}

fn caption(state: &State, sheet: &Checklist) -> String {
    let [a, b, c] = state
        .body
        .principal_moments_g_mm2
        .map(|moment| quantity(moment, "g·mm²"));
    let height = match sheet.goal.aim.kind {
        GoalKind::Top | GoalKind::Stand => {
            format!(
                "; its centre of mass {} up",
                quantity(state.body.center_height_mm, "mm")
            )
        }
        _ => String::new(),
    };
    format!(
        "{}: {}, I_a = {a}, I_b = {b}, I_c = {c}{height}.",
        state.name,
        quantity(state.body.mass_g, "g")
    )
}

/// Draws the goal's axis over the whole height, and a triangle at its point.
fn draw_goal_axis(drawing: &mut Drawing, projection: &Projection, sheet: &Checklist) {
    let frame = sheet.goal.aim.frame();
    let [x, _] = projection.at(&frame.origin);
    let [_, height] = drawing.size_px();
    drawing.line([[x, 6.0], [x, height - 6.0]], Stroke::DASH_DOT);
    let [_, y] = projection.at(&frame.origin);
    let tip = [[x, y], [x - 11.0, y + 18.0], [x + 11.0, y + 18.0]];
    drawing.path(&[tip.to_vec()], true, Paint::filled(PAPER, Stroke::THICK));
}

/// Draws the ellipsoid of the same mass and inertia. With second moments S about the centre it is
/// { x : xᵀ S⁻¹ x ≤ 5/m }, and its projection has the projected second moments.
fn draw_ellipsoid(drawing: &mut Drawing, projection: &Projection, body: &Body) {
    let second = Matrix::identity() * (0.5 * body.inertia_g_mm2.trace()) - body.inertia_g_mm2;
    let [right, up, _] = projection.axes;
    let squared = |a: &Vector, b: &Vector| {
        ELLIPSOID_RATIO / body.mass_g * a.dot(&(second * b)) * projection.scale * projection.scale
    };
    // Pixels count downward, so the mixed moment changes its sign.
    let ([major, minor], angle) = ellipse([
        squared(&right, &right),
        -squared(&right, &up),
        squared(&up, &up),
    ]);
    let [x, y] = projection.at(&body.center).map(short);
    drawing.add(&format!(
        "<ellipse rx=\"{}\" ry=\"{}\" transform=\"translate({x} {y}) rotate({})\" fill=\"{ELLIPSOID}\" fill-opacity=\"0.25\" \
         stroke=\"{ELLIPSOID}\" stroke-width=\"3\"/>",
        short(major),
        short(minor),
        short(angle.to_degrees())
    ));
}

/// Returns the semi-axes of { p : pᵀ M⁻¹ p ≤ 1 } for M = [[a, b], [b, c]], the longer one first.
/// The second value is the angle of the longer one, rad.
fn ellipse([a, b, c]: [f64; 3]) -> ([f64; 2], f64) {
    let (mean, half) = (0.5 * (a + c), (0.5 * (a - c)).hypot(b));
    (
        [(mean + half).max(0.0).sqrt(), (mean - half).max(0.0).sqrt()],
        0.5 * (2.0 * b).atan2(a - c),
    )
}

/// Draws the principal axes up to the ellipsoid, that of I_c thick.
fn draw_principal_axes(drawing: &mut Drawing, projection: &Projection, body: &Body) {
    let principal = body.principal();
    let trace = principal.moments_g_mm2.iter().sum::<f64>();
    let names = ["I_a", "I_b", "I_c"];
    for (index, (moment, name)) in principal.moments_g_mm2.iter().zip(names).enumerate() {
        let semi_mm = (ELLIPSOID_RATIO / body.mass_g * (0.5 * trace - moment))
            .max(0.0)
            .sqrt();
        let along: Vector = principal.axes.column(index) * semi_mm;
        let up = if along.dot(&projection.axes[1]) < 0.0 {
            -along
        } else {
            along
        };
        let ends = [body.center - up, body.center + up].map(|end| projection.at(&end));
        drawing.line(
            ends,
            if index == 2 {
                Stroke::THICK
            } else {
                Stroke::DASHED
            },
        );
        let [from, to] = ends;
        let length = (to[0] - from[0]).hypot(to[1] - from[1]);
        if length > 4.0 * CENTER_PX {
            let beyond = 0.8 * TEXT_PX / length;
            let size = drawing.size_px();
            let inside =
                |i: usize| (to[i] + beyond * (to[i] - from[i])).clamp(TEXT_PX, size[i] - TEXT_PX);
            drawing.text([inside(0), inside(1)], Anchor::Middle, name);
        }
    }
}

/// Draws the symbol of a centre of mass: a disc in quarters.
fn draw_center(drawing: &mut Drawing, [x, y]: Spot) {
    let ink = hex(INK);
    drawing.circle([x, y], CENTER_PX, Paint::filled(PAPER, Stroke::THIN));
    let r = CENTER_PX;
    let (x, y) = (short(x), short(y));
    drawing.add(&format!(
        "<path d=\"M{x} {y}v-{r}a{r} {r} 0 0 1 {r} {r}zM{x} {y}v{r}a{r} {r} 0 0 1 -{r} -{r}z\" fill=\"{ink}\"/>"
    ));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_ellipse_has_the_axes_of_its_matrix() {
        let ([major, minor], angle) = ellipse([4.0, 0.0, 9.0]);
        assert_eq!([major, minor], [3.0, 2.0]);
        assert!((angle.abs() - std::f64::consts::FRAC_PI_2).abs() < 1e-15);
        // The same ellipse turned by 45°: M = R diag(9, 4) Rᵀ = [[6.5, 2.5], [2.5, 6.5]].
        let ([major, minor], angle) = ellipse([6.5, 2.5, 6.5]);
        assert!((major - 3.0).abs() < 1e-12 && (minor - 2.0).abs() < 1e-12);
        assert!((angle - std::f64::consts::FRAC_PI_4).abs() < 1e-15);
    }

    #[test]
    fn the_ellipsoid_of_a_solid_ball_is_its_outline() {
        // m = 5 g, r = 2 mm: I = 2/5 m r² = 8 g·mm²; S = 4 about each axis, so 5/m · S = r².
        let inertia = Matrix::identity() * 8.0;
        let second = Matrix::identity() * (0.5 * inertia.trace()) - inertia;
        assert!((ELLIPSOID_RATIO / 5.0 * second[(0, 0)] - 4.0).abs() < 1e-12);
    }
}
