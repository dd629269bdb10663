//! Reads binary glTF with rigid nodes and linear animations.

use std::cell::Cell;

use nalgebra::{Quaternion, UnitQuaternion};

use super::layout::{
    Accessor, AnimationRow, BIN_CHUNK, Channel, FLOAT, GlbError, Gltf, INT, JSON_CHUNK, MAGIC,
    NORM_LIMIT, NodeRow, SHORT, VERSION,
};
use super::scene::{ReadAnimation, ReadNode, ReadScene, ReadTrack, Values};
use crate::geom::{Frame, Point};
use crate::mesh::TriMesh;

/// Reads a binary glTF file with one root and rigid nodes below it.
///
/// # Errors
/// The file is broken, or has what such a file does not: another scale, a matrix, a node with two
/// parents, several primitives, other interpolations. A key that is not known here is refused, too.
///
/// Time and memory grow with the length of the file alone.
pub fn decode_glb(bytes: &[u8]) -> Result<ReadScene, GlbError> {
    let (json, bin) = chunks(bytes)?;
    let gltf: Gltf =
        serde_json::from_slice(json).map_err(|error| GlbError::Json(error.to_string()))?;
    if gltf.asset.version != "2.0" {
        return Err(GlbError::Frame("its version is not 2.0"));
    }
    let is_whole = |length: usize| length == bin.len();
    if gltf.buffers.len() != 1 || !gltf.buffers.iter().all(|own| is_whole(own.byte_length)) {
        return Err(broken("the list of buffers"));
    }
    let reader = Reader {
        gltf: &gltf,
        bin,
        left: Cell::new(bin.len().saturating_mul(READS)),
    };
    reader.scene()
}

/// Readings of a byte: two tracks of a node share their times.
const READS: usize = 2;

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
    if 28 + json.len() + bin.len() != bytes.len() {
        return Err(GlbError::Frame("it has more than two chunks"));
    }
    Ok((json, bin))
}

struct Reader<'a> {
    gltf: &'a Gltf,
    bin: &'a [u8],
    /// The bytes that may still be read, so that no file makes much of a few bytes.
    left: Cell<usize>,
}

impl Reader<'_> {
    fn scene(&self) -> Result<ReadScene, GlbError> {
        let gltf = self.gltf;
        let ([scene], 0) = (gltf.scenes.as_slice(), gltf.scene) else {
            return Err(broken("the list of scenes"));
        };
        let [root] = scene.nodes.as_slice() else {
            return Err(broken("the list of roots"));
        };
        let order = self.order(*root)?;
        let row = &gltf.nodes[*root];
        let scale = row.scale.unwrap_or([1.0; 3]);
        if scale.iter().any(|side| *side != scale[0]) || row.mesh.is_some() {
            return Err(broken("the root"));
        }
        let mut place_of = vec![None; gltf.nodes.len()];
        let mut is_used = vec![false; gltf.meshes.len()];
        let mut nodes = Vec::new();
        for step in &order {
            place_of[step.node] = Some(nodes.len());
            let row = &gltf.nodes[step.node];
            if row.scale.is_some_and(|scale| scale != [1.0; 3]) {
                return Err(broken("the scale of a node"));
            }
            if row.mesh.is_some_and(|mesh| is_taken(&mut is_used, mesh)) {
                return Err(broken("a mesh's number"));
            }
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
            root: place(row)?,
            nodes,
            animations: animations.collect::<Result<_, GlbError>>()?,
        })
    }

    /// Returns the nodes below the root, each once and after its parent.
    fn order(&self, root: usize) -> Result<Vec<Step>, GlbError> {
        let nodes = &self.gltf.nodes;
        let mut is_child = vec![false; nodes.len()];
        for &child in nodes.iter().flat_map(|row| &row.children) {
            if is_taken(&mut is_child, child) {
                return Err(broken("the tree of nodes"));
            }
        }
        // With one parent each, and none of the root, no way comes back to a node.
        if is_taken(&mut is_child, root) {
            return Err(broken("the tree of nodes"));
        }
        let below = |node: usize, parent: Option<usize>| {
            let children = nodes[node].children.iter().rev();
            children.map(move |&node| Step { node, parent })
        };
        let mut open: Vec<Step> = below(root, None).collect();
        let mut found: Vec<Step> = Vec::new();
        while let Some(step) = open.pop() {
            open.extend(below(step.node, Some(step.node)));
            found.push(step);
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
        let mut is_used = vec![false; row.samplers.len()];
        let tracks = row.channels.iter().map(|channel| {
            if is_taken(&mut is_used, channel.sampler) {
                return Err(broken("a sampler's number"));
            }
            let node = place_of.get(channel.target.node).copied().flatten();
            let node = node.ok_or_else(|| broken("the node of an animation"))?;
            self.track(row, channel, node)
        });
        let tracks: Vec<ReadTrack> = tracks.collect::<Result<_, GlbError>>()?;
        let key = |track: &ReadTrack| (track.node, matches!(track.values, Values::Turns(_)));
        let mut moved: Vec<_> = tracks.iter().map(key).collect();
        moved.sort_unstable();
        if moved.windows(2).any(|pair| pair[0] == pair[1]) {
            return Err(broken("an animation that moves a node twice"));
        }
        Ok(ReadAnimation {
            name: row.name.clone(),
            tracks,
        })
    }

    /// Returns the motion of a node by a channel whose sampler is there.
    fn track(
        &self,
        row: &AnimationRow,
        channel: &Channel,
        node: usize,
    ) -> Result<ReadTrack, GlbError> {
        let sampler = &row.samplers[channel.sampler];
        let times = self.floats::<1>(sampler.input, "SCALAR")?;
        let times_s: Vec<f64> = times.into_iter().map(|[time]| time).collect();
        let values = match channel.target.path.as_str() {
            "translation" => {
                let all = self.floats::<3>(sampler.output, "VEC3")?;
                Values::Places(all.into_iter().map(Point::from).collect())
            }
            "rotation" => {
                let all = self.floats::<4>(sampler.output, "VEC4")?;
                Values::Turns(all.into_iter().map(turn).collect::<Result<_, GlbError>>()?)
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
            if view.buffer != 0 || !view.byte_offset.is_multiple_of(N) {
                return None;
            }
            let end = view.byte_offset.checked_add(view.byte_length)?;
            self.bin.get(view.byte_offset..end)
        });
        let length = accessor.count.checked_mul(N * each);
        let own = own.zip(length).and_then(|(own, length)| own.get(..length));
        let own = own.ok_or_else(|| broken("a view of bytes"))?;
        let left = self.left.get().checked_sub(own.len());
        self.left
            .set(left.ok_or_else(|| broken("bytes that are used again and again"))?);
        Ok(own.as_chunks::<N>().0.iter().copied())
    }
}

/// A node, and the node that carries it.
struct Step {
    node: usize,
    parent: Option<usize>,
}

/// Takes a number; returns true if there is none such, or it was taken before.
fn is_taken(taken: &mut [bool], number: usize) -> bool {
    let own = taken.get_mut(number);
    own.is_none_or(|own| std::mem::replace(own, true))
}

fn turn([x, y, z, w]: [f64; 4]) -> Result<UnitQuaternion<f64>, GlbError> {
    let turn = Quaternion::new(w, x, y, z);
    // What is no number is not near, either.
    let is_unit = (turn.norm() - 1.0).abs() <= NORM_LIMIT;
    let unit = is_unit.then(|| UnitQuaternion::from_quaternion(turn));
    unit.ok_or_else(|| broken("the length of a turn"))
}

fn place(row: &NodeRow) -> Result<Frame, GlbError> {
    let origin = row.translation.unwrap_or_default();
    if row.matrix.is_some() || !origin.iter().all(|side| side.is_finite()) {
        return Err(broken("the place of a node"));
    }
    let turn = turn(row.rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]))?;
    Ok(Frame {
        origin: Point::from(origin),
        axes: turn.to_rotation_matrix().into_inner(),
    })
}
