//! Edges that are kept, one after the other, become ways from node to node.

use crate::voronoi::exact::Diagram;

use super::{MedialAxis, Place, Way};

/// No node.
const NONE: u32 = u32::MAX;

/// An edge, and whether it is followed from its end to its beginning.
type Link = (u32, bool);

/// The axis that consists of the edges that are kept.
pub(super) fn join(diagram: &Diagram, kept: &[bool], chord: f64) -> MedialAxis {
    let mut leaving: Vec<Vec<Link>> = vec![Vec::new(); diagram.vertices().len()];
    for (number, edge) in (0_u32..).zip(diagram.edges()).filter(|&(number, _)| kept[number as usize]) {
        leaving[edge.from as usize].push((number, false));
        leaving[edge.to as usize].push((number, true));
    }
    let mut joiner = Joiner { diagram, chord, leaving, seen: kept.iter().map(|kept| !kept).collect() };
    let mut axis = MedialAxis { faults: diagram.faults().to_vec(), ..MedialAxis::default() };
    if joiner.leaving.iter().all(Vec::is_empty) {
        // The area has shrunk to the vertex at which it is widest.
        let places = (0_u32..).take(diagram.vertices().len()).map(|vertex| joiner.place(vertex));
        axis.nodes.extend(places.max_by(|a, b| a.clearance.total_cmp(&b.clearance)));
        axis.dots.extend((!axis.nodes.is_empty()).then_some(0));
        return axis;
    }
    let mut numbers = vec![NONE; diagram.vertices().len()];
    for (vertex, number) in joiner.nodes().into_iter().zip(0_u32..) {
        numbers[vertex as usize] = number;
        axis.nodes.push(joiner.place(vertex));
    }
    for vertex in (0_u32..).take(numbers.len()).filter(|&vertex| numbers[vertex as usize] != NONE) {
        for link in joiner.leaving[vertex as usize].clone() {
            if !joiner.seen[link.0 as usize] {
                let (course, last) = joiner.follow(link);
                let ends = Some([numbers[vertex as usize], numbers[last as usize]]);
                axis.ways.push(Way { ends, course });
            }
        }
    }
    for number in (0_u32..).take(kept.len()) {
        if !joiner.seen[number as usize] {
            let (course, _) = joiner.follow((number, false));
            axis.ways.push(Way { ends: None, course });
        }
    }
    axis
}

struct Joiner<'a> {
    diagram: &'a Diagram,
    chord: f64,
    leaving: Vec<Vec<Link>>,
    /// The edges that are left out or in a way already.
    seen: Vec<bool>,
}

impl Joiner<'_> {
    fn place(&self, vertex: u32) -> Place {
        let vertex = &self.diagram.vertices()[vertex as usize];
        Place { at: vertex.at, clearance: vertex.clearance }
    }

    /// The vertices at which one edge ends, or more than two meet.
    fn nodes(&self) -> Vec<u32> {
        let is_node = |links: &[Link]| match links {
            [] => false,
            [one, other] => one.0 == other.0,
            _ => true,
        };
        (0_u32..).zip(&self.leaving).filter(|(_, links)| is_node(links)).map(|(vertex, _)| vertex).collect()
    }

    /// The places along the edges from `link` on to the next node, and the vertex that this is.
    fn follow(&mut self, mut link: Link) -> (Vec<Place>, u32) {
        let mut course: Vec<Place> = Vec::new();
        loop {
            let (number, reversed) = link;
            self.seen[number as usize] = true;
            let edge = self.diagram.edges()[number as usize];
            let mut part: Vec<Place> = self
                .diagram
                .profile(&edge, self.chord)
                .into_iter()
                .map(|(at, clearance)| Place { at, clearance })
                .collect();
            if reversed {
                part.reverse();
            }
            course.extend(part.into_iter().skip(usize::from(!course.is_empty())));
            let last = if reversed { edge.from } else { edge.to };
            let next = match self.leaving[last as usize][..] {
                [one, other] => [one, other].into_iter().find(|next| !self.seen[next.0 as usize]),
                _ => None,
            };
            match next {
                Some(next) => link = next,
                None => return (course, last),
            }
        }
    }
}
