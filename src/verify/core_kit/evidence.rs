//! What the judge of an object on a base sees.

use super::base_files::{CoreCertificate, PanelsFile};
use super::promise::{CorePartKind, CorePromise};
use crate::geom::{Frame, Matrix, Plane, Point, Vector};
use crate::io::DrawnLine;
use crate::mesh::TriMesh;

/// Everything that the judge sees.
#[derive(Debug, Clone, PartialEq)]
pub struct CoreEvidence {
    /// The promises.
    pub promise: CorePromise,
    /// The certificate.
    pub certificate: CoreCertificate,
    /// The panels.
    pub panels: PanelsFile,
    /// The triangles of the model, in the order of its file.
    pub model: TriMesh,
    /// The printed parts in the order of the promises, each in the model's frame and its own size.
    pub parts: Vec<TriMesh>,
    /// The triangles of the same parts as their files hold them. A turn into the model rounds every
    /// corner, and slivers that touch in a file may then cross.
    pub files: Vec<TriMesh>,
    /// The lines of every sheet, by its DXF and by its SVG.
    pub drawings: Vec<[Vec<DrawnLine>; 2]>,
}

impl CoreEvidence {
    /// Returns the polyhedra of the certificate.
    pub(super) fn bases(&self) -> Vec<BaseEvidence<'_>> {
        let planes =
            |numbers: &[[f64; 4]]| numbers.iter().map(|&numbers| plane_of(numbers)).collect();
        let bases = self.certificate.bases().map(|of| BaseEvidence {
            planes: planes(&of.planes),
            sides: planes(&of.sides),
            faces: &of.faces,
        });
        bases.collect()
    }

    /// Returns the polyhedron and the plane of a panel, by its index; `None` if there is none.
    pub(super) fn base_of<'a, 'b>(
        &self,
        bases: &'b [BaseEvidence<'a>],
        panel: usize,
    ) -> Option<(&'b BaseEvidence<'a>, usize)> {
        let of = self.panels.panels.get(panel)?;
        let base = bases.get(of.polyhedron.wrapping_sub(1))?;
        Some((base, of.plane))
    }

    /// Returns the ids and meshes of the parts of the shell.
    pub(super) fn shell(&self) -> impl Iterator<Item = (usize, &TriMesh)> {
        let parts = self.promise.parts.iter().zip(&self.parts).enumerate();
        let shell = parts.filter(|(_, (part, _))| part.kind == CorePartKind::Shell);
        shell.map(|(index, (_, mesh))| (index, mesh))
    }

    /// Returns the index of a part by its id.
    pub(super) fn part(&self, id: &str) -> Option<usize> {
        self.promise.parts.iter().position(|part| part.id == id)
    }

    /// Returns the frame of a panel by its index.
    pub(super) fn frame(&self, panel: usize) -> Frame {
        let of = &self.panels.panels[panel];
        Frame {
            origin: Point::from(of.origin_mm),
            axes: Matrix::from_columns(&of.axes.map(Vector::from)),
        }
    }
}

/// A polyhedron of the base.
pub(super) struct BaseEvidence<'a> {
    /// Its planes.
    pub planes: Vec<Plane>,
    /// The planes between it and other polyhedra.
    pub sides: Vec<Plane>,
    /// For each piece of the surface, the index of the plane that parts it.
    pub faces: &'a [u32],
}

/// Returns the plane of four numbers: normal and offset.
pub(super) fn plane_of([x, y, z, offset_mm]: [f64; 4]) -> Plane {
    Plane {
        normal: Vector::new(x, y, z),
        offset_mm,
    }
}
