//! Reads binary glTF with rigid nodes and linear animations.

use nalgebra::{Quaternion, UnitQuaternion};

use super::layout::{
    Accessor, AnimationRow, BIN_CHUNK, FLOAT, GlbError, Gltf, INT, JSON_CHUNK, MAGIC, NodeRow,
    SHORT, VERSION,
};
use crate::geom::{Frame, Point};
use crate::mesh::TriMesh;

/// A scene as it was read. The one root stands for the unit and the direction up; all is told in
/// its frame, mm.
#[derive(Debug, Clone, PartialEq)]
pub struct ReadScene {
    /// The scale of the root: 0.001 if its nodes are in mm.
    pub scale: f64,
    /// The nodes but the root; each after its parent.
    pub nodes: Vec<ReadNode>,
    /// The animations.
    pub animations: Vec<ReadAnimation>,
}

/// A node.
#[derive(Debug, Clone, PartialEq)]
pub struct ReadNode {
    /// Its name.
    pub name: String,
    /// The index of the node that carries it.
    pub parent: Option<usize>,
    /// Its place in its parent's frame.
    pub place: Frame,
    /// Its body, in its own frame.
    pub mesh: Option<TriMesh>,
}

/// An animation.
#[derive(Debug, Clone, PartialEq)]
pub struct ReadAnimation {
    /// Its name.
    pub name: String,
    /// The motions of single nodes.
    pub tracks: Vec<ReadTrack>,
}

/// The motion of a node.
#[derive(Debug, Clone, PartialEq)]
pub struct ReadTrack {
    /// The index of the node.
    pub node: usize,
    /// The times, s.
    pub times_s: Vec<f64>,
    /// The values at these times.
    pub values: Values,
}

/// The values of a track.
#[derive(Debug, Clone, PartialEq)]
pub enum Values {
    /// Places of the node's origin.
    Places(Vec<Point>),
    /// Turns of the node.
    Turns(Vec<UnitQuaternion<f64>>),
}

impl ReadScene {
    /// Returns the places of all nodes in the root's frame at a time of an animation, s.
    ///
    /// It is as the format has it: linear between keys, along the great arc for turns.
    pub fn places(&self, animation: &ReadAnimation, time_s: f64) -> Vec<Frame> {
        let mut own: Vec<Frame> = self.nodes.iter().map(|node| node.place).collect();
        for track in &animation.tracks {
            let after = track.times_s.partition_point(|time| *time <= time_s);
            let last = track.times_s.len() - 1;
            let [from, to] = [after.saturating_sub(1), after.min(last)];
            let [start, end] = [from, to].map(|at| track.times_s[at]);
            let share = if end > start {
                ((time_s - start) / (end - start)).clamp(0.0, 1.0)
            } else {
                0.0
            };
            let place = &mut own[track.node];
            match &track.values {
                Values::Places(all) => place.origin = all[from] + (all[to] - all[from]) * share,
                Values::Turns(all) => {
                    let turn = all[from].try_slerp(&all[to], share, 1e-9);
                    let turn = turn.unwrap_or(all[from]);
                    place.axes = turn.to_rotation_matrix().into_inner();
                }
            }
        }
        let mut places: Vec<Frame> = Vec::with_capacity(own.len());
        for (node, own) in self.nodes.iter().zip(&own) {
            let placed = match node.parent {
                Some(parent) => places[parent].frame_to_model(own),
                None => *own,
            };
            places.push(placed);
        }
        places
    }
}

/// Reads a binary glTF file with one root and rigid nodes below it.
///
/// # Errors
/// The file is broken, or has what such a file does not: another scale, a matrix, a node with two
/// parents, several primitives, other interpolations.
pub fn decode_glb(bytes: &[u8]) -> Result<ReadScene, GlbError> {
    let (json, bin) = chunks(bytes)?;
    let gltf: Gltf =
        serde_json::from_slice(json).map_err(|error| GlbError::Json(error.to_string()))?;
    if gltf.asset.version != "2.0" {
        return Err(GlbError::Frame("its version is not 2.0"));
    }
    let reader = Reader { gltf: &gltf, bin };
    reader.scene()
}

fn broken(what: &str) -> GlbError {
    GlbError::Broken(what.to_owned())
}

/// Returns the chunks of JSON and of bytes.
fn chunks(bytes: &[u8]) -> Result<(&[u8], &[u8]), GlbError> {
    let word = |at: usize| {
        let own = bytes.get(at..at.checked_add(4)?)?;
        Some(u32::from_le_bytes(own.try_into().ok()?))
    };
    if word(0) != Some(MAGIC) || word(4) != Some(VERSION) {
        return Err(GlbError::Frame("it does not begin so"));
    }
    if word(8).map(|length| length as usize) != Some(bytes.len()) {
        return Err(GlbError::Frame("it is not as long as it says"));
    }
    let chunk = |at: usize, kind: u32, why: &'static str| {
        let length = word(at).filter(|_| word(at + 4) == Some(kind));
        let end = length.and_then(|length| (at + 8).checked_add(length as usize));
        let own = end.and_then(|end| bytes.get(at + 8..end));
        own.ok_or(GlbError::Frame(why))
    };
    let json = chunk(12, JSON_CHUNK, "its JSON is cut off")?;
    let bin = chunk(20 + json.len(), BIN_CHUNK, "its bytes are cut off")?;
    Ok((json, bin))
}

struct Reader<'a> {
    gltf: &'a Gltf,
    bin: &'a [u8],
}

impl Reader<'_> {
    fn scene(&self) -> Result<ReadScene, GlbError> {
        let gltf = self.gltf;
        let scene = gltf.scenes.get(gltf.scene);
        let roots = scene.map(|scene| scene.nodes.as_slice());
        let Some([root]) = roots else {
            return Err(broken("the list of roots"));
        };
        let order = self.order(*root)?;
        let scale = gltf.nodes[*root].scale.unwrap_or([1.0; 3]);
        if scale.iter().any(|side| *side != scale[0]) {
            return Err(broken("the scale of the root"));
        }
        let mut place_of = vec![None; gltf.nodes.len()];
        let mut nodes = Vec::new();
        for step in &order {
            place_of[step.node] = Some(nodes.len());
            let row = &gltf.nodes[step.node];
            nodes.push(ReadNode {
                name: row.name.clone(),
                parent: step.parent.and_then(|parent| place_of[parent]),
                place: place(row)?,
                mesh: row.mesh.map(|mesh| self.mesh(mesh)).transpose()?,
            });
        }
        let animations = gltf.animations.iter();
        let animations = animations.map(|row| self.animation(row, &place_of));
        Ok(ReadScene {
            scale: scale[0],
            nodes,
            animations: animations.collect::<Result<_, GlbError>>()?,
        })
    }

    /// Returns the nodes below the root, each once and after its parent.
    fn order(&self, root: usize) -> Result<Vec<Step>, GlbError> {
        let nodes = &self.gltf.nodes;
        let mut is_known = vec![false; nodes.len()];
        let mut found: Vec<Step> = Vec::new();
        let mut open = vec![root];
        while let Some(parent) = open.pop() {
            let row = nodes.get(parent).ok_or_else(|| broken("a node's number"))?;
            if std::mem::replace(&mut is_known[parent], true) {
                return Err(broken("the tree of nodes"));
            }
            for &node in row.children.iter().rev() {
                open.push(node);
            }
            let carrier = nodes.iter().position(|row| row.children.contains(&parent));
            if parent != root {
                found.push(Step {
                    node: parent,
                    parent: carrier.filter(|carrier| *carrier != root),
                });
            }
        }
        Ok(found)
    }

    fn mesh(&self, index: usize) -> Result<TriMesh, GlbError> {
        let row = self.gltf.meshes.get(index);
        let Some([primitive]) = row.map(|row| row.primitives.as_slice()) else {
            return Err(broken("a mesh"));
        };
        let position = self.floats::<3>(primitive.attributes.position, "VEC3")?;
        let corners = self.accessor(primitive.indices, "SCALAR")?;
        let corners: Vec<u32> = match corners.component_type {
            SHORT => {
                let own = self.values::<2>(corners, 1)?;
                own.map(u16::from_le_bytes).map(u32::from).collect()
            }
            INT => self
                .values::<4>(corners, 1)?
                .map(u32::from_le_bytes)
                .collect(),
            _ => return Err(broken("the type of vertex numbers")),
        };
        let (triangles, rest) = corners.as_chunks::<3>();
        let points = position.into_iter().map(Point::from).collect();
        let mesh = TriMesh::new(points, triangles.to_vec());
        match mesh {
            Ok(mesh) if rest.is_empty() => Ok(mesh),
            _ => Err(broken("a mesh")),
        }
    }

    fn animation(
        &self,
        row: &AnimationRow,
        place_of: &[Option<usize>],
    ) -> Result<ReadAnimation, GlbError> {
        let tracks = row.channels.iter().map(|channel| {
            let sampler = row.samplers.get(channel.sampler);
            let sampler = sampler.ok_or_else(|| broken("a sampler's number"))?;
            let node = place_of.get(channel.target.node).copied().flatten();
            let node = node.ok_or_else(|| broken("the node of an animation"))?;
            let times = self.floats::<1>(sampler.input, "SCALAR")?;
            let times_s: Vec<f64> = times.into_iter().map(|[time]| time).collect();
            let values = match channel.target.path.as_str() {
                "translation" => {
                    let all = self.floats::<3>(sampler.output, "VEC3")?;
                    Values::Places(all.into_iter().map(Point::from).collect())
                }
                "rotation" => {
                    let all = self.floats::<4>(sampler.output, "VEC4")?;
                    Values::Turns(all.into_iter().map(turn).collect())
                }
                _ => return Err(broken("the path of an animation")),
            };
            let count = match &values {
                Values::Places(all) => all.len(),
                Values::Turns(all) => all.len(),
            };
            let rises = times_s.windows(2).all(|pair| pair[0] < pair[1]);
            let is_sound = count == times_s.len() && count > 0 && rises;
            if !is_sound || sampler.interpolation != "LINEAR" {
                return Err(broken("a sampler"));
            }
            Ok(ReadTrack {
                node,
                times_s,
                values,
            })
        });
        Ok(ReadAnimation {
            name: row.name.clone(),
            tracks: tracks.collect::<Result<_, GlbError>>()?,
        })
    }

    fn accessor(&self, index: usize, shape: &str) -> Result<&Accessor, GlbError> {
        let own = self.gltf.accessors.get(index);
        own.filter(|own| own.shape == shape)
            .ok_or_else(|| broken("an accessor"))
    }

    fn floats<const N: usize>(&self, index: usize, shape: &str) -> Result<Vec<[f64; N]>, GlbError> {
        let accessor = self.accessor(index, shape)?;
        if accessor.component_type != FLOAT {
            return Err(broken("the type of numbers"));
        }
        let numbers = self.values::<4>(accessor, N)?.map(f32::from_le_bytes);
        let numbers: Vec<f64> = numbers.map(f64::from).collect();
        if numbers.iter().any(|number| !number.is_finite()) {
            return Err(broken("a number"));
        }
        Ok(numbers.as_chunks::<N>().0.to_vec())
    }

    /// Returns the bytes of an accessor, a number of `N` bytes after the other, `each` a value.
    fn values<const N: usize>(
        &self,
        accessor: &Accessor,
        each: usize,
    ) -> Result<impl Iterator<Item = [u8; N]> + use<'_, N>, GlbError> {
        let view = self.gltf.views.get(accessor.buffer_view);
        let own = view.and_then(|view| {
            let end = view.byte_offset.checked_add(view.byte_length)?;
            self.bin.get(view.byte_offset..end)
        });
        let length = accessor.count.checked_mul(N * each);
        let own = own.zip(length).and_then(|(own, length)| own.get(..length));
        let own = own.ok_or_else(|| broken("a view of bytes"))?;
        Ok(own.as_chunks::<N>().0.iter().copied())
    }
}

/// A node, and the node that carries it.
struct Step {
    node: usize,
    parent: Option<usize>,
}

fn turn([x, y, z, w]: [f64; 4]) -> UnitQuaternion<f64> {
    UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z))
}

fn place(row: &NodeRow) -> Result<Frame, GlbError> {
    if row.scale.is_some_and(|scale| scale != [1.0; 3]) || row.matrix.is_some() {
        return Err(broken("the place of a node"));
    }
    let turn = turn(row.rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]));
    Ok(Frame {
        origin: Point::from(row.translation.unwrap_or_default()),
        axes: turn.to_rotation_matrix().into_inner(),
    })
}
