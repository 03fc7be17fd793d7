//! Which nets are coupled, and how much a limit helps.

use voromill::board::{Attributes, Axis, Copper, Feature, Shape, Side};
use voromill::coupling::strips::{Substrate, capacitance};
use voromill::coupling::{Coupling, Layout};
use voromill::geometry::{Nm, Point};
use voromill::topology::{self, Method, NetId};
use voromill::voronoi::{Diagram, Frame, Settings};

const KERF: Nm = Nm::from_um(200);

/// Level traces 40 mm long and 0.4 mm wide, at these heights in micrometres.
fn traces(heights: &[i64]) -> Copper {
    let at = |x: i64, y: i64| Point::new(Nm::from_um(x), Nm::from_um(y));
    let trace = |&y: &i64| {
        let (from, to) = (at(0, y), at(40_000, y));
        let shape = Shape::Stroke { from, to, radius: Nm::from_um(200) };
        Feature { axis: Axis::Line(from, to), shape, attributes: 0, line: 1 }
    };
    let features = heights.iter().map(trace).collect();
    Copper { side: Side::Front, features, attributes: vec![Attributes::default()] }
}

fn coupling(copper: &Copper) -> Coupling {
    let nets = topology::recover(copper, Method::Contact);
    let settings = Settings { frame: Frame::Rectangle(Nm::from_um(300)), ..Settings::default() };
    let diagram = Diagram::new(copper, &nets, None, &settings).expect("a diagram");
    let extents = topology::extents(copper, &nets);
    Coupling::new(
        &diagram,
        &diagram.boundaries().expect("whole boundaries"),
        &extents,
        KERF,
        Substrate::fr4(1.6),
    )
}

#[test]
fn two_long_traces_are_two_coplanar_strips() {
    // A gap of 1 mm, between strips that end as half discs 0.4 mm wide.
    let found = coupling(&traces(&[0, 1400]));
    let [pair] = found.pairs.as_slice() else { panic!("one pair: {found:?}") };
    let drawn = found.of(pair, Layout::Drawn);
    // 40 mm side by side, and at either end half a millimetre of boundary beyond.
    assert!((drawn.length_over_gap / 40.0 - 1.0).abs() < 0.03, "{drawn:?}");
    let width = 0.398; // twice the area by the perimeter of such a strip
    let expected = 40.6 * capacitance(1.0, [width, width], Substrate::fr4(1.6));
    assert!((drawn.picofarads / expected - 1.0).abs() < 0.03, "{drawn:?}, not {expected}");
    let regions = found.of(pair, Layout::Regions);
    assert!((regions.length_over_gap / (pair.length / 1e6 / 0.2) - 1.0).abs() < 1e-6, "{regions:?}");
    assert!(regions.picofarads > 1.5 * drawn.picofarads, "{regions:?} beside {drawn:?}");
}

#[test]
fn a_limit_takes_most_of_what_regions_add() {
    let found = coupling(&traces(&[0, 3000, 3900]));
    let (alone, close) = (NetId(0), NetId(2));
    let limit = found.limit_for(alone).expect("a limit helps the net that stands alone");
    assert!(limit < Nm::from_um(1300), "its regions do not meet: {limit}");
    let [drawn, regions, limited] =
        [Layout::Drawn, Layout::Regions, Layout::Limited(limit)].map(|layout| found.of_net(alone, layout));
    assert!(drawn < limited && limited - drawn <= 0.2 * (regions - drawn), "{drawn} {limited} {regions}");
    let far = Layout::Limited(Nm::from_mm(5));
    assert!(
        found.of_net(close, far) <= found.of_net(close, Layout::Regions) * (1.0 + 1e-9),
        "a far limit adds nothing"
    );
}
