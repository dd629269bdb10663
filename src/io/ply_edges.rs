//! Reads the edges of a PLY file.

use super::ply::{Body, Element, PlyError, fault, header, read_vertices};
use super::values::Values;
use crate::geom::Point;

/// Returns the vertices of a PLY file, and its edges as pairs of them.
pub(super) fn decode_edges(bytes: &[u8]) -> Result<(Vec<Point>, Vec<[usize; 2]>), PlyError> {
    let (form, elements, body) = header(bytes)?;
    let mut body = Body(Values::new(body, form));
    let (mut vertices, mut edges) = (Vec::new(), Vec::new());
    for element in &elements {
        match element.name.as_str() {
            "vertex" => vertices = read_vertices(&mut body, element)?,
            "edge" => edges = read_edges(&mut body, element)?,
            _ => body.for_each_item(element, |_, _| Ok(()))?,
        }
    }
    Ok((vertices, edges))
}

fn read_edges(body: &mut Body, element: &Element) -> Result<Vec<[usize; 2]>, PlyError> {
    let end = |name: &str| {
        let mut properties = element.properties.iter();
        properties.position(|property| property.name == name)
    };
    let ends = ["vertex1", "vertex2"].map(end);
    let mut edges = Vec::new();
    body.for_each_item(element, |index, values| {
        let mut edge = [0; 2];
        for (place, end) in edge.iter_mut().zip(ends) {
            let value = end.and_then(|end| values[end].first().copied());
            let whole = value.filter(|x| x.fract() == 0.0 && *x >= 0.0);
            let words = || format!("{value:?}");
            *place = whole.ok_or_else(|| fault(element, index, "end", words()))? as usize;
        }
        edges.push(edge);
        Ok(())
    })?;
    Ok(edges)
}
