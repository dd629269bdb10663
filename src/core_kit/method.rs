//! The orders that the method of the paper cannot carry out.

use super::error::CoreRunError;
use crate::base::setting::{Key, Setting};
use crate::job::base_method::BaseMethod;
use crate::job::core_kit::CoreJob;
use crate::polyhedra::vertices::StartSolid;

/// Refuses an order that the method of the paper cannot carry out.
///
/// # Errors
/// Vertices make one polyhedron, and keep the faces of their start.
pub fn check_method(job: &CoreJob) -> Result<(), CoreRunError> {
    let starts = job.method.starts();
    let fewest = starts.into_iter().map(StartSolid::face_count).min();
    let (Some(fewest), None) = (fewest, &job.base) else {
        return Ok(());
    };
    if !job.polyhedra.is_one() {
        return Err(CoreRunError::VerticesOfSeveral {
            polyhedra: job.polyhedra,
        });
    }
    if job.faces < fewest {
        return Err(CoreRunError::FewerThanStart { fewest });
    }
    Ok(())
}

/// Returns the starts that are tried: those of the method with no more faces than asked for.
pub fn starts_tried(job: &CoreJob) -> Vec<StartSolid> {
    let starts = job.method.starts().into_iter();
    let tried = starts.filter(|start| start.face_count() <= job.faces);
    tried.collect()
}

/// Returns what to type for each start that is not tried: the method, and its faces.
pub fn other_starts(job: &CoreJob) -> Vec<[Setting; 2]> {
    let tried = starts_tried(job);
    let others = StartSolid::ALL
        .iter()
        .filter(|start| !tried.contains(start));
    let settings = others.map(|&start| {
        let method = BaseMethod::Vertices(Some(start));
        let faces = Setting::new(Key::Faces, start.face_count());
        [Setting::new(Key::Method, method), faces]
    });
    settings.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::job::core_kit::CutChoice;
    use crate::job::{ModelChoice, PrinterChoice, Scaling};

    fn job(method: &str, faces: usize) -> CoreJob {
        let model = ModelChoice {
            path: "hare.stl".into(),
            sha256: None,
            scaling: Scaling::Size("600mm".parse().unwrap()),
        };
        let printer = PrinterChoice {
            id: "prusa-mk3s".to_owned(),
            material: None,
        };
        let cutting = CutChoice::new("makerspace-900x600", "birch-5");
        CoreJob {
            method: method.parse().unwrap(),
            faces,
            ..CoreJob::new(model, printer, cutting)
        }
    }

    #[test]
    fn starts_that_are_not_tried_are_told_with_their_faces() {
        let told = |method: &str, faces: usize| -> Vec<String> {
            let others = other_starts(&job(method, faces)).into_iter();
            others
                .map(|[method, faces]| format!("{method}, {faces}"))
                .collect()
        };
        let icosahedron = "method = \"vertices:icosahedron\", faces = \"20\"";
        assert_eq!(told("vertices", 12), [icosahedron]);
        assert_eq!(told("vertices", 20), [""; 0]);
        let others = told("vertices:dodecahedron", 12);
        assert_eq!(others.len(), 2);
        assert!(others[0].contains("cube") && others[1] == icosahedron);
    }

    #[test]
    fn fewer_faces_than_a_start_has_are_refused_with_the_number_to_give() {
        let refused = check_method(&job("vertices:dodecahedron", 11)).unwrap_err();
        let said = refused.to_string();
        assert!(
            said.contains("which has 12") && said.contains("faces = \"12\""),
            "{said}"
        );
        check_method(&job("vertices", 6)).unwrap();
    }
}
