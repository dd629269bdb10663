//! Writes moving bodies as binary glTF.

use nalgebra::{Rotation3, UnitQuaternion};

use super::layout::{
    Accessor, AnimationRow, Asset, Attributes, BIN_CHUNK, Buffer, BufferView, Channel, FLOAT,
    GlbError, Gltf, INDICES, INT, JSON_CHUNK, MAGIC, MM_PER_M, MaterialRow, MeshRow, NodeRow,
    Primitive, SHORT, Sampler, SceneRow, Surface, Target, VERSION, VERTICES, linear,
};
use crate::geom::{Frame, Vector};
use crate::io::Rgb;
use crate::mesh::TriMesh;

/// The fourth of a value in a chunk: chunks end at a multiple of it.
const WORD: usize = 4;
/// Roughness of printed surfaces: no mirror, no chalk.
const ROUGHNESS: f64 = 0.6;

/// A scene of rigid bodies that move.
#[derive(Debug, Clone, PartialEq)]
pub struct MovingScene<'a> {
    /// Its name.
    pub name: String,
    /// The direction that points up, in the model's axes.
    pub up: Vector,
    /// The nodes; each comes after its parent.
    pub nodes: Vec<SceneNode<'a>>,
    /// The animations.
    pub animations: Vec<Animation>,
}

/// A node of the tree.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneNode<'a> {
    /// Its name.
    pub name: String,
    /// The index of the node that carries it; `None` for one that stands in the model.
    pub parent: Option<usize>,
    /// Its place in its parent's frame, mm.
    pub place: Frame,
    /// Its body, in its own frame.
    pub body: Option<Painted<'a>>,
}

/// A body with its colour.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Painted<'a> {
    /// The body, mm.
    pub mesh: &'a TriMesh,
    /// The colour.
    pub color: Rgb,
}

/// A motion of some nodes.
#[derive(Debug, Clone, PartialEq)]
pub struct Animation {
    /// Its name.
    pub name: String,
    /// The motions of single nodes, each node once.
    pub tracks: Vec<Track>,
}

/// The motion of a node in its parent's frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Track {
    /// The index of the node.
    pub node: usize,
    /// The times, s, in rising order.
    pub times_s: Vec<f64>,
    /// The places at these times, mm.
    pub places: Vec<Frame>,
}

impl MovingScene<'_> {
    /// Returns the file: metres, y up, as the format has it. The same scene gives the same bytes.
    ///
    /// # Errors
    /// A node comes before its parent, or a length does not fit the format.
    pub fn encode(&self) -> Result<Vec<u8>, GlbError> {
        let mut writer = Writer::default();
        let root = NodeRow {
            name: self.name.clone(),
            rotation: Some(quaternion(&upright(&self.up))),
            scale: Some([1.0 / MM_PER_M; 3]),
            ..NodeRow::default()
        };
        writer.gltf.nodes.push(root);
        for (index, node) in self.nodes.iter().enumerate() {
            writer.node(index, node)?;
        }
        for animation in &self.animations {
            writer.animation(animation);
        }
        writer.finish(&self.name)
    }
}

/// Returns the frame whose axes turn a direction into the y axis.
fn upright(up: &Vector) -> Frame {
    let y = Vector::y();
    let turn = Rotation3::rotation_between(up, &y);
    // Opposite directions have no one rotation: any half turn across will do.
    let turn =
        turn.unwrap_or_else(|| Rotation3::from_axis_angle(&Vector::x_axis(), std::f64::consts::PI));
    Frame {
        axes: turn.into_inner(),
        ..Frame::identity()
    }
}

fn quaternion(frame: &Frame) -> [f64; 4] {
    let turn = Rotation3::from_matrix_unchecked(frame.axes);
    let turn = UnitQuaternion::from_rotation_matrix(&turn);
    [turn.i, turn.j, turn.k, turn.w]
}

#[derive(Default)]
struct Writer {
    gltf: Gltf,
    bytes: Vec<u8>,
}

impl Writer {
    fn node(&mut self, index: usize, node: &SceneNode) -> Result<(), GlbError> {
        let mesh = match &node.body {
            Some(body) => Some(self.mesh(&node.name, body)?),
            None => None,
        };
        let own = self.gltf.nodes.len();
        self.gltf.nodes.push(NodeRow {
            name: node.name.clone(),
            translation: Some(node.place.origin.coords.into()),
            rotation: Some(quaternion(&node.place)),
            mesh,
            ..NodeRow::default()
        });
        let parent = match node.parent {
            Some(parent) if parent >= index => {
                return Err(GlbError::Broken(format!("the parent of {}", node.name)));
            }
            // The root of all is the first node.
            Some(parent) => parent + 1,
            None => 0,
        };
        self.gltf.nodes[parent].children.push(own);
        Ok(())
    }

    fn mesh(&mut self, name: &str, body: &Painted) -> Result<usize, GlbError> {
        let vertices = body.mesh.vertices();
        let single = |value: f64| value as f32;
        let coordinates: Vec<f32> = vertices
            .iter()
            .flat_map(|p| [p.x, p.y, p.z].map(single))
            .collect();
        let bound = |pick: fn(f32, f32) -> f32, axis: usize| {
            let own = coordinates.iter().skip(axis).step_by(3).copied();
            f64::from(own.reduce(pick).unwrap_or(0.0))
        };
        let bounds = |pick| [0, 1, 2].map(|axis| bound(pick, axis)).to_vec();
        let (min, max) = (bounds(f32::min), bounds(f32::max));
        let count = vertices.len();
        let bytes: Vec<u8> = coordinates.iter().flat_map(|c| c.to_le_bytes()).collect();
        let position = self.accessor(&bytes, Some(VERTICES), Kind::of_floats(count, "VEC3"));
        self.gltf.accessors[position].min = min;
        self.gltf.accessors[position].max = max;
        let corners: Vec<u32> = body.mesh.triangles().iter().flatten().copied().collect();
        let corner_count = corners.len();
        // The greatest number of 16 bits restarts primitives, so it is no vertex.
        let (component, bytes) = if count < usize::from(u16::MAX) {
            let short = |corner: &u32| (*corner as u16).to_le_bytes();
            (SHORT, corners.iter().flat_map(short).collect::<Vec<u8>>())
        } else {
            let int = |corner: &u32| corner.to_le_bytes();
            (INT, corners.iter().flat_map(int).collect())
        };
        let kind = Kind {
            component,
            count: corner_count,
            shape: "SCALAR",
        };
        let indices = self.accessor(&bytes, Some(INDICES), kind);
        let material = self.material(body.color);
        self.gltf.meshes.push(MeshRow {
            name: name.to_owned(),
            primitives: vec![Primitive {
                attributes: Attributes { position },
                indices,
                material: Some(material),
            }],
        });
        Ok(self.gltf.meshes.len() - 1)
    }

    /// Returns the index of the material of a colour.
    fn material(&mut self, color: Rgb) -> usize {
        let [red, green, blue] = color.map(linear_share);
        let own = MaterialRow {
            name: format!("#{:02x}{:02x}{:02x}", color[0], color[1], color[2]),
            surface: Surface {
                base_color_factor: [red, green, blue, 1.0],
                metallic_factor: 0.0,
                roughness_factor: ROUGHNESS,
            },
        };
        let known = self.gltf.materials.iter().position(|other| *other == own);
        known.unwrap_or_else(|| {
            self.gltf.materials.push(own);
            self.gltf.materials.len() - 1
        })
    }

    fn animation(&mut self, animation: &Animation) {
        let mut row = AnimationRow {
            name: animation.name.clone(),
            channels: Vec::new(),
            samplers: Vec::new(),
        };
        for track in &animation.tracks {
            let input = self.times(&track.times_s);
            let count = track.places.len();
            let places = track.places.iter();
            let to = places.flat_map(|place| <[f64; 3]>::from(place.origin.coords));
            let to = self.floats(to, Kind::of_floats(count, "VEC3"));
            let turns = continuous(track.places.iter().map(quaternion));
            let turns = self.floats(turns.into_iter().flatten(), Kind::of_floats(count, "VEC4"));
            for (path, output) in [("translation", to), ("rotation", turns)] {
                row.channels.push(Channel {
                    sampler: row.samplers.len(),
                    target: Target {
                        node: track.node + 1,
                        path: path.to_owned(),
                    },
                });
                row.samplers.push(Sampler {
                    input,
                    output,
                    interpolation: linear(),
                });
            }
        }
        self.gltf.animations.push(row);
    }

    fn times(&mut self, times_s: &[f64]) -> usize {
        let kind = Kind::of_floats(times_s.len(), "SCALAR");
        let input = self.floats(times_s.iter().copied(), kind);
        let end = |time: Option<&f64>| vec![f64::from(time.copied().unwrap_or(0.0) as f32)];
        self.gltf.accessors[input].min = end(times_s.first());
        self.gltf.accessors[input].max = end(times_s.last());
        input
    }

    fn floats(&mut self, values: impl Iterator<Item = f64>, kind: Kind) -> usize {
        let bytes: Vec<u8> = values.flat_map(|v| (v as f32).to_le_bytes()).collect();
        self.accessor(&bytes, None, kind)
    }

    /// Adds bytes as a view of their own, and returns the index of their accessor.
    fn accessor(&mut self, bytes: &[u8], target: Option<u32>, kind: Kind) -> usize {
        self.gltf.views.push(BufferView {
            buffer: 0,
            byte_offset: self.bytes.len(),
            byte_length: bytes.len(),
            target,
        });
        self.bytes.extend_from_slice(bytes);
        pad(&mut self.bytes, 0);
        self.gltf.accessors.push(Accessor {
            buffer_view: self.gltf.views.len() - 1,
            component_type: kind.component,
            count: kind.count,
            shape: kind.shape.to_owned(),
            min: Vec::new(),
            max: Vec::new(),
        });
        self.gltf.accessors.len() - 1
    }

    fn finish(mut self, name: &str) -> Result<Vec<u8>, GlbError> {
        self.gltf.asset = Asset {
            version: "2.0".to_owned(),
            generator: concat!("equipoise ", env!("CARGO_PKG_VERSION")).to_owned(),
        };
        self.gltf.scenes.push(SceneRow {
            name: name.to_owned(),
            nodes: vec![0],
        });
        self.gltf.buffers.push(Buffer {
            byte_length: self.bytes.len(),
        });
        let json = serde_json::to_vec(&self.gltf);
        let mut json = json.map_err(|error| GlbError::Json(error.to_string()))?;
        pad(&mut json, b' ');
        let chunks = [(JSON_CHUNK, json), (BIN_CHUNK, self.bytes)];
        let long = |length: usize| {
            u32::try_from(length).map_err(|_| GlbError::Frame("it is longer than 4 GiB"))
        };
        let whole: usize = chunks.iter().map(|(_, bytes)| 8 + bytes.len()).sum();
        let mut file = Vec::with_capacity(12 + whole);
        for word in [MAGIC, VERSION, long(12 + whole)?] {
            file.extend(word.to_le_bytes());
        }
        for (kind, bytes) in chunks {
            file.extend(long(bytes.len())?.to_le_bytes());
            file.extend(kind.to_le_bytes());
            file.extend(bytes);
        }
        Ok(file)
    }
}

/// The values of an accessor: their type, their number and what each is.
struct Kind {
    component: u32,
    count: usize,
    shape: &'static str,
}

impl Kind {
    fn of_floats(count: usize, shape: &'static str) -> Self {
        Self {
            component: FLOAT,
            count,
            shape,
        }
    }
}

/// Fills bytes up to whole words.
fn pad(bytes: &mut Vec<u8>, with: u8) {
    bytes.resize(bytes.len().next_multiple_of(WORD), with);
}

/// Returns quaternions of which each is on the side of the one before it, so that what lies
/// between two is the short way.
fn continuous(turns: impl Iterator<Item = [f64; 4]>) -> Vec<[f64; 4]> {
    let mut last = [0.0; 4];
    let turns = turns.map(|turn| {
        let along: f64 = turn.iter().zip(last).map(|(a, b)| a * b).sum();
        last = if along < 0.0 { turn.map(|c| -c) } else { turn };
        last
    });
    turns.collect()
}

/// Returns the linear share of a channel of sRGB (IEC 61966-2-1).
fn linear_share(channel: u8) -> f64 {
    let share = f64::from(channel) / 255.0;
    if share <= 0.04045 {
        share / 12.92
    } else {
        ((share + 0.055) / 1.055).powf(2.4)
    }
}
