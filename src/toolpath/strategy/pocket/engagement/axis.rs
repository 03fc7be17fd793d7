//! The medial axis as far as the tool's middle fits, as a graph.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use crate::geometry::between;
use crate::toolpath::ordered::Ordered;
use crate::toolpath::strategy::pocket::course::{Spot, distance};
use crate::voronoi::medial::{MedialAxis, Place};

/// A part of the axis between two nodes, along which the tool's middle fits.
#[derive(Clone, Debug)]
pub(super) struct Edge {
    pub(super) ends: [usize; 2],
    /// Places with how far from each the tool's middle may go.
    pub(super) course: Vec<Place>,
    /// How far along it each of them is.
    along: Vec<f64>,
}

impl Edge {
    fn new(ends: [usize; 2], course: Vec<Place>) -> Self {
        let mut along = vec![0.0];
        let mut sum = 0.0;
        for pair in course.windows(2) {
            sum += distance(pair[0].at, pair[1].at);
            along.push(sum);
        }
        Self { ends, course, along }
    }

    pub(super) fn reversed(&self) -> Self {
        let [from, to] = self.ends;
        Self::new([to, from], self.course.iter().rev().copied().collect())
    }

    pub(super) fn length(&self) -> f64 {
        self.along.last().copied().unwrap_or(0.0)
    }

    /// The place so far along it.
    pub(super) fn at(&self, along: f64) -> Place {
        let i = self.along.partition_point(|&start| start <= along).clamp(1, self.course.len() - 1) - 1;
        let (length, [a, b]) = (self.along[i + 1] - self.along[i], [self.course[i], self.course[i + 1]]);
        let part = if length > 0.0 { ((along - self.along[i]) / length).clamp(0.0, 1.0) } else { 0.0 };
        Place { at: between(a.at, b.at, part), clearance: a.clearance + (b.clearance - a.clearance) * part }
    }

    /// The places from one distance to another, farther on.
    pub(super) fn part(&self, from: f64, to: f64) -> Vec<Place> {
        let inner = self.course.iter().zip(&self.along);
        let inner = inner.filter(|&(_, &along)| along > from && along < to).map(|(place, _)| *place);
        std::iter::once(self.at(from)).chain(inner).chain([self.at(to)]).collect()
    }
}

/// What is connected of the axis.
#[derive(Clone, Debug, Default)]
pub(super) struct Graph {
    pub(super) nodes: Vec<Place>,
    pub(super) edges: Vec<Edge>,
    /// The edges at each node.
    pub(super) at: Vec<Vec<usize>>,
}

impl Graph {
    /// The axis with the clearance lessened by `wall`, as far as that leaves something, and of that
    /// by `stock`, at most a part of it.
    pub(super) fn new(axis: &MedialAxis, wall: f64, stock: f64, most: f64) -> Self {
        let less = |place: &Place| {
            let room = place.clearance - wall;
            Place { at: place.at, clearance: room - stock.min(room.max(0.0) * most) }
        };
        // Between places what is left changes evenly, but for these clearances.
        let turns = if stock > 0.0 { vec![wall, wall + stock / most] } else { Vec::new() };
        let mut graph = Self::default();
        for place in &axis.nodes {
            graph.node(less(place));
        }
        for way in &axis.ways {
            let course: Vec<Place> = with_places_at(&turns, &way.course).iter().map(less).collect();
            match way.ends {
                Some(ends) => graph.add_clipped(ends.map(|end| end as usize), &course),
                None => graph.add_loop(course),
            }
        }
        graph.split_at_widest();
        graph
    }

    fn node(&mut self, place: Place) -> usize {
        self.nodes.push(place);
        self.at.push(Vec::new());
        self.nodes.len() - 1
    }

    fn edge(&mut self, ends: [usize; 2], course: Vec<Place>) {
        if course.len() > 1 {
            for end in ends {
                self.at[end].push(self.edges.len());
            }
            self.edges.push(Edge::new(ends, course));
        }
    }

    /// A loop begins where it is widest.
    fn add_loop(&mut self, mut course: Vec<Place>) {
        course.pop();
        let Some(first) = widest(&course) else { return };
        course.rotate_left(first);
        course.push(course[0]);
        let node = self.node(course[0]);
        self.add_clipped([node, node], &course);
    }

    /// Adds the parts of a way along which something is left.
    fn add_clipped(&mut self, [from, to]: [usize; 2], course: &[Place]) {
        let mut part: Vec<Place> = Vec::new();
        let mut begins = from;
        for (i, &place) in course.iter().enumerate() {
            let before = i.checked_sub(1).map(|i| course[i]);
            let crossing = before.filter(|before| (before.clearance < 0.0) != (place.clearance < 0.0));
            if let Some(crossing) = crossing.map(|before| before.toward(place, 0.0)) {
                let node = self.node(crossing);
                if place.clearance < 0.0 {
                    part.push(crossing);
                    self.edge([begins, node], std::mem::take(&mut part));
                } else {
                    begins = node;
                    part.push(crossing);
                }
            }
            if place.clearance >= 0.0 {
                part.push(place);
            }
        }
        self.edge([begins, to], part);
    }

    /// Where an edge is wider between its ends than at them, it becomes two.
    fn split_at_widest(&mut self) {
        for number in 0..self.edges.len() {
            let edge = &self.edges[number];
            let Some(middle) = widest(&edge.course).filter(|&i| i > 0 && i + 1 < edge.course.len()) else {
                continue;
            };
            let ends = edge.ends.map(|end| self.nodes[end].clearance);
            if edge.course[middle].clearance <= ends[0].max(ends[1]) {
                continue;
            }
            let [from, to] = edge.ends;
            let rest = edge.course[middle..].to_vec();
            let first = edge.course[..=middle].to_vec();
            let node = self.node(first[middle]);
            if let Some(end) = self.at[to].iter_mut().rev().find(|edge| **edge == number) {
                *end = self.edges.len();
            }
            self.at[node].extend([number, self.edges.len()]);
            self.edges[number] = Edge::new([from, node], first);
            self.edges.push(Edge::new([node, to], rest));
        }
    }

    /// The nodes from which each part of it is cleared: the widest of each connected part.
    pub(super) fn roots(&self) -> Vec<usize> {
        let mut part = vec![usize::MAX; self.nodes.len()];
        let mut roots: Vec<usize> = Vec::new();
        for first in 0..self.nodes.len() {
            if part[first] != usize::MAX || self.nodes[first].clearance < 0.0 {
                continue;
            }
            let (mut open, mut best) = (vec![first], first);
            part[first] = first;
            while let Some(node) = open.pop() {
                if self.nodes[node].clearance > self.nodes[best].clearance {
                    best = node;
                }
                for &edge in &self.at[node] {
                    for next in self.edges[edge].ends {
                        if part[next] == usize::MAX {
                            part[next] = first;
                            open.push(next);
                        }
                    }
                }
            }
            roots.push(best);
        }
        roots
    }

    /// How far each node is from `from` along edges that `is_open`, and the edge that leads there.
    pub(super) fn ways(&self, from: usize, is_open: impl Fn(usize) -> bool) -> Vec<Reached> {
        let mut reached = vec![Reached { far: f64::INFINITY, by: None }; self.nodes.len()];
        let mut open = BinaryHeap::from([Reverse((Ordered(0.0), from))]);
        reached[from].far = 0.0;
        while let Some(Reverse((Ordered(far), node))) = open.pop() {
            if far > reached[node].far {
                continue;
            }
            for &number in self.at[node].iter().filter(|&&number| is_open(number)) {
                let edge = &self.edges[number];
                let next = edge.ends[usize::from(edge.ends[0] == node)];
                let far = far + edge.length();
                if far < reached[next].far {
                    reached[next] = Reached { far, by: Some(number) };
                    open.push(Reverse((Ordered(far), next)));
                }
            }
        }
        reached
    }

    /// The places on the way to a node, as `ways` found it.
    pub(super) fn way(&self, reached: &[Reached], to: usize) -> Vec<Spot> {
        let (mut node, mut found) = (to, vec![self.nodes[to].at]);
        while let Some(number) = reached[node].by {
            let edge = &self.edges[number];
            let course: Vec<Spot> = edge.course.iter().map(|place| place.at).collect();
            let is_forward = edge.ends[1] == node;
            if is_forward {
                found.extend(course.iter().rev().skip(1));
            } else {
                found.extend(course.iter().skip(1));
            }
            node = edge.ends[usize::from(!is_forward)];
        }
        found.reverse();
        found
    }
}

/// A course with places where it has one of some clearances, the least first.
fn with_places_at(clearances: &[f64], course: &[Place]) -> Vec<Place> {
    let Some(&first) = course.first() else { return Vec::new() };
    let mut places = vec![first];
    for pair in course.windows(2) {
        let (low, high) =
            (pair[0].clearance.min(pair[1].clearance), pair[0].clearance.max(pair[1].clearance));
        let between = clearances.iter().filter(|&&clearance| low < clearance && clearance < high);
        let found = between.map(|&clearance| pair[0].toward(pair[1], clearance));
        let start = places.len();
        places.extend(found);
        if pair[0].clearance > pair[1].clearance {
            places[start..].reverse();
        }
        places.push(pair[1]);
    }
    places
}

/// How a node is reached.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reached {
    pub(super) far: f64,
    by: Option<usize>,
}

/// The first of the widest places.
fn widest(course: &[Place]) -> Option<usize> {
    let by_clearance =
        |a: &usize, b: &usize| course[*a].clearance.total_cmp(&course[*b].clearance).then(b.cmp(a));
    (0..course.len()).max_by(by_clearance)
}
