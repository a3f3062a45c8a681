//! Triangles cut in halves: the mesh on which light is solved for.
//!
//! A triangle is cut from the middle of its longest edge, and all that share this edge with it (Rivara 1984): no corner ever lies
//! on another triangle's edge, so there are no T-vertices to be anchored, and triangles do not grow thin. A sphere is an
//! octahedron whose midpoints are moved to the sphere, so that its triangles are exact parts of it.

use glam::Vec3;
use illuminant_scene::Geometry;
use std::collections::HashMap;

const NONE: u32 = u32::MAX;

/// A triangle of the tree.
#[derive(Clone, Copy, Debug)]
struct Node {
    /// Numbers of its corners, counter-clockwise seen from outside.
    corners: [u32; 3],
    /// The corner opposite to the edge that is cut, once it is.
    apex: u8,
    /// The first of its two halves; `NONE` for a leaf.
    halves: u32,
    parent: u32,
}

/// What an object is cut from.
#[derive(Clone, Copy, Debug)]
struct Root {
    /// The first of its triangles: as many as it has primitives, or eight for a sphere.
    first: u32,
    sphere: Option<(Vec3, f32)>,
}

/// A place on a leaf.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Located {
    /// The leaf's node.
    pub node: u32,
    /// How much each of its corners counts there; the sum is 1.
    pub weights: [f32; 3],
}

/// All surfaces of a scene, as it is when the shutter opens, as trees of triangles.
#[derive(Clone, Debug)]
pub struct Subdivision {
    corners: Vec<Vec3>,
    nodes: Vec<Node>,
    roots: Vec<Root>,
    /// The leaves at each edge, by its corners in order.
    edges: HashMap<(u32, u32), Vec<u32>>,
    /// The corner at a place of an object, so that triangles that touch share it.
    welded: HashMap<(u32, [u32; 3]), u32>,
    /// The object of each node.
    objects: Vec<u32>,
}

fn key(a: u32, b: u32) -> (u32, u32) {
    (a.min(b), a.max(b))
}

impl Subdivision {
    /// The triangles of a scene, not yet cut.
    #[must_use]
    pub fn new(geometry: &Geometry) -> Self {
        let mut all = Self {
            corners: Vec::new(),
            nodes: Vec::new(),
            roots: Vec::new(),
            edges: HashMap::new(),
            welded: HashMap::new(),
            objects: Vec::new(),
        };
        for object in 0..geometry.objects() {
            let sphere = geometry.sphere(object);
            all.roots.push(Root { first: all.nodes.len() as u32, sphere });
            if let Some((center, radius)) = sphere {
                for octant in 0..8u32 {
                    let axis = |i: u32| {
                        let sign = if octant >> i & 1 == 0 { radius } else { -radius };
                        center + Vec3::AXES[i as usize] * sign
                    };
                    let [x, y, z] = [axis(0), axis(1), axis(2)];
                    // An odd number of mirrored axes turns the triangle round.
                    let odd = octant.count_ones() % 2 == 1;
                    all.add_root(object as u32, if odd { [x, z, y] } else { [x, y, z] });
                }
            } else {
                for primitive in 0..geometry.primitives(object) {
                    // A mesh has as many triangles as it says.
                    let corners = geometry.triangle(object, primitive, 0.0).unwrap_or_default();
                    all.add_root(object as u32, corners);
                }
            }
        }
        all
    }

    fn corner(&mut self, object: u32, place: Vec3) -> u32 {
        // Adding 0 makes −0 and 0 the same.
        let bits = (place + Vec3::ZERO).to_array().map(f32::to_bits);
        let next = self.corners.len() as u32;
        let corner = *self.welded.entry((object, bits)).or_insert(next);
        if corner == next {
            self.corners.push(place);
        }
        corner
    }

    fn add_root(&mut self, object: u32, corners: [Vec3; 3]) {
        let corners = corners.map(|p| self.corner(object, p));
        self.add(object, corners, NONE);
    }

    fn add(&mut self, object: u32, corners: [u32; 3], parent: u32) {
        let node = self.nodes.len() as u32;
        self.nodes.push(Node { corners, apex: 0, halves: NONE, parent });
        self.objects.push(object);
        for i in 0..3 {
            // A triangle that is no more than a line has one edge twice.
            let at = self.edges.entry(key(corners[i], corners[(i + 1) % 3])).or_default();
            if at.last() != Some(&node) {
                at.push(node);
            }
        }
    }

    /// Which corner is opposite to the longest edge; equal ones are told apart by their numbers, alike from both sides.
    fn apex(&self, node: u32) -> usize {
        let c = self.nodes[node as usize].corners;
        let rank = |apex: usize| {
            let (a, b) = (c[(apex + 1) % 3], c[(apex + 2) % 3]);
            let d = self.corners[a as usize] - self.corners[b as usize];
            (d.length_squared(), key(a, b))
        };
        let longer = |i: &usize, j: &usize| {
            let (a, b) = (rank(*i), rank(*j));
            a.0.total_cmp(&b.0).then(a.1.cmp(&b.1))
        };
        (0..3).max_by(longer).unwrap_or(0)
    }

    fn longest(&self, node: u32) -> (u32, u32) {
        let (c, apex) = (self.nodes[node as usize].corners, self.apex(node));
        key(c[(apex + 1) % 3], c[(apex + 2) % 3])
    }

    fn is_leaf(&self, node: u32) -> bool {
        self.nodes[node as usize].halves == NONE
    }

    /// Cuts a leaf in halves, and whatever of its neighbours must be cut for that; nothing if it is no leaf.
    pub fn bisect(&mut self, node: u32) {
        let mut waiting = vec![node];
        while let Some(&last) = waiting.last() {
            if !self.is_leaf(last) {
                waiting.pop();
                continue;
            }
            let edge = self.longest(last);
            // One whose own longest edge is another is cut first; along such a chain edges grow, so it ends.
            let at = self.edges.get(&edge).map_or(&[][..], |at| at);
            match at.iter().copied().find(|&n| self.longest(n) != edge) {
                Some(other) => waiting.push(other),
                None if at.contains(&last) => self.cut(edge),
                // What has no such edge is no triangle to be cut.
                None => {
                    waiting.pop();
                }
            }
        }
    }

    /// Cuts all leaves at an edge that is the longest of each.
    fn cut(&mut self, edge: (u32, u32)) {
        let Some(leaves) = self.edges.remove(&edge) else { return };
        let object = self.objects[leaves[0] as usize];
        let middle = self.middle(object, edge);
        for leaf in leaves {
            let apex = self.apex(leaf);
            let corners = self.nodes[leaf as usize].corners;
            let [p, a, b] = [0, 1, 2].map(|i| corners[(apex + i) % 3]);
            for (c, d) in [(p, a), (p, b)] {
                if let Some(at) = self.edges.get_mut(&key(c, d)) {
                    at.retain(|&n| n != leaf);
                }
            }
            let halves = self.nodes.len() as u32;
            let node = &mut self.nodes[leaf as usize];
            (node.apex, node.halves) = (apex as u8, halves);
            self.add(object, [p, a, middle], leaf);
            self.add(object, [p, middle, b], leaf);
        }
    }

    fn middle(&mut self, object: u32, (a, b): (u32, u32)) -> u32 {
        let [a, b] = [a, b].map(|i| self.corners[i as usize]);
        let middle = match self.roots[object as usize].sphere {
            Some((center, radius)) => center + ((a - center) + (b - center)).normalize() * radius,
            None => (a + b) * 0.5,
        };
        self.corner(object, middle)
    }

    /// The leaves, in the order of their trees.
    #[must_use]
    pub fn leaves(&self) -> Vec<u32> {
        let mut found = Vec::new();
        let roots = (0..self.nodes.len() as u32).filter(|&n| self.nodes[n as usize].parent == NONE);
        let mut waiting: Vec<u32> = roots.collect();
        waiting.reverse();
        while let Some(node) = waiting.pop() {
            match self.nodes[node as usize].halves {
                NONE => found.push(node),
                halves => waiting.extend([halves + 1, halves]),
            }
        }
        found
    }

    /// How many nodes there are, halved ones included.
    #[must_use]
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Whether there is nothing.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// The numbers of a node's corners.
    #[must_use]
    pub fn corners(&self, node: u32) -> [u32; 3] {
        self.nodes[node as usize].corners
    }

    /// Where a corner is, in the world.
    #[must_use]
    pub fn position(&self, corner: u32) -> Vec3 {
        self.corners[corner as usize]
    }

    /// How many corners there are.
    #[must_use]
    pub fn count_of_corners(&self) -> usize {
        self.corners.len()
    }

    /// The triangle that a node is half of.
    #[must_use]
    pub fn parent(&self, node: u32) -> Option<u32> {
        let parent = self.nodes[node as usize].parent;
        (parent != NONE).then_some(parent)
    }

    /// The object of a node.
    #[must_use]
    pub fn object(&self, node: u32) -> u32 {
        self.objects[node as usize]
    }

    /// The sphere that an object is.
    #[must_use]
    pub fn sphere(&self, object: u32) -> Option<(Vec3, f32)> {
        self.roots[object as usize].sphere
    }

    /// The primitive of its object that a node is part of; 0 for a sphere.
    #[must_use]
    pub fn primitive(&self, node: u32) -> u32 {
        let mut root = node;
        while let Some(parent) = self.parent(root) {
            root = parent;
        }
        let of = self.roots[self.object(node) as usize];
        if of.sphere.is_some() { 0 } else { root - of.first }
    }

    /// The leaf at a point of an object, met at a primitive with the barycentric coordinates of its second and third corner.
    #[inline]
    #[must_use]
    pub fn locate(&self, object: u32, primitive: u32, barycentric: [f32; 2], position: Vec3) -> Located {
        let root = &self.roots[object as usize];
        let (mut node, mut weights) = match root.sphere {
            Some((center, _)) => {
                // In an octant of axes the coordinates are the weights.
                let d = position - center;
                let octant = (0..3).filter(|&i| d[i] < 0.0).fold(0u32, |bits, i| bits | 1 << i);
                let [x, y, z] = d.abs().to_array();
                let odd = octant.count_ones() % 2 == 1;
                (root.first + octant, if odd { [x, z, y] } else { [x, y, z] })
            }
            None => {
                let [v, w] = barycentric;
                (root.first + primitive, [1.0 - v - w, v, w])
            }
        };
        loop {
            let Node { corners, apex, halves, .. } = self.nodes[node as usize];
            if halves == NONE {
                break;
            }
            let apex = apex as usize;
            let [p, a, b] = [0, 1, 2].map(|i| weights[(apex + i) % 3]);
            // a A + b B, with the smaller weight times A + B, which is the middle but for its length.
            let length = match root.sphere {
                None => 2.0,
                Some((center, radius)) => {
                    let [a, b] = [1, 2].map(|i| self.corners[corners[(apex + i) % 3] as usize] - center);
                    (a + b).length() / radius
                }
            };
            (node, weights) =
                if a >= b { (halves, [p, a - b, length * b]) } else { (halves + 1, [p, length * a, b - a]) };
        }
        let sum: f32 = weights.iter().sum();
        Located { node, weights: weights.map(|w| (w / sum).clamp(0.0, 1.0)) }
    }
}
