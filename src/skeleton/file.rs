//! `skeleton.toml`: a skeleton as text, to edit and hand back.
//!
//! ```toml
//! kind = "skeleton"
//! schema = 1
//! root = 2                      # the node from which the telescopes grow
//! open = [[2, 3]]               # links that are cut, so that no ring is left
//!
//! [nodes]                       # number = [x, y, z, radius of the ball], mm
//! 1 = [0.0, 0.0, 0.0, 4.0]
//! 2 = [0.0, 0.0, 20.0, 5.0]
//! 3 = [0.0, 0.0, 40.0, 3.0]
//!
//! [[branch]]                    # a run of nodes between tips and junctures
//! nodes = [1, 2]
//! solid = true                  # no shells are made of it [default: false]
//!
//! [[branch]]
//! nodes = [2, 3]
//! ```

use std::collections::BTreeMap;
use std::fmt::Write;
use std::ops::Range;

use serde::Deserialize;
use toml::Spanned;

use super::tree::{Branch, Node, Skeleton, StaysSolid};
use crate::base::toml_text::{self, Place, TextFault};
use crate::geom::Point;

/// The word that tells a skeleton from other files.
const KIND: &str = "skeleton";
/// The version of the file that this program writes and reads.
const SCHEMA: u32 = 1;
/// Digits after the point of a written length: a tenth of a micrometre.
const DIGITS: usize = 4;
/// The most nodes of a file. A skeleton has some hundred.
const MOST_NODES: usize = 100_000;
/// The greatest coordinate and radius, mm: a kilometre is no print.
const MOST_MM: f64 = 1e6;
/// Numbers of a branch on one line of the file.
const NUMBERS_A_LINE: usize = 16;

/// The key that tells the kind of a file.
#[derive(Deserialize)]
struct Head {
    kind: Spanned<String>,
}

/// The file as it stands.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Text {
    #[serde(rename = "kind")]
    _kind: String,
    schema: Spanned<u32>,
    root: Spanned<u32>,
    #[serde(default)]
    open: Vec<Spanned<[u32; 2]>>,
    nodes: Spanned<BTreeMap<Spanned<String>, Spanned<[f64; 4]>>>,
    #[serde(default)]
    branch: Vec<BranchText>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct BranchText {
    nodes: Spanned<Vec<Spanned<u32>>>,
    #[serde(default)]
    solid: bool,
}

/// A fault of a file and the piece of the text where it is.
struct Fault {
    span: Range<usize>,
    message: String,
}

impl Fault {
    fn at<T>(spanned: &Spanned<T>, message: String) -> Self {
        Self {
            span: spanned.span(),
            message,
        }
    }
}

impl Skeleton {
    /// Returns the skeleton as text, with `model` named in its head.
    pub fn to_toml(&self, model: &str) -> String {
        let id = |node: usize| self.nodes[node].id;
        let open: Vec<String> = self
            .open
            .iter()
            .map(|[a, b]| format!("[{}, {}]", id(*a), id(*b)))
            .collect();
        // A name with a line break would end the comment.
        let model = model.replace(char::is_control, " ");
        let mut text = format!(
            "# The skeleton of {model}. Lengths are in mm.\n\
             # Edit it: move, add or remove nodes and branches, then check it with equipoise skeleton.\n\
             kind = \"{KIND}\"\n\
             schema = {SCHEMA}\n\
             # The node from which the telescopes grow.\n\
             root = {}\n\
             # Links that are cut, so that no ring is left: pairs of neighbours in a branch.\n\
             open = [{}]\n\n\
             # number = [x, y, z, radius of the largest ball there]\n\
             [nodes]\n",
            id(self.root),
            open.join(", ")
        );
        for node in &self.nodes {
            let [x, y, z] = node.at.coords.into();
            let numbers = [x, y, z, node.radius_mm].map(|mm| format!("{:.DIGITS$}", mm + 0.0));
            _ = writeln!(text, "{} = [{}]", node.id, numbers.join(", "));
        }
        text.push_str(
            "\n# A branch is a run of nodes between tips and junctures. With solid = true no\n\
             # shells are made of it: it stays one piece with its juncture.\n",
        );
        for branch in &self.branches {
            text += &self.branch_text(branch);
        }
        text
    }

    fn branch_text(&self, branch: &Branch) -> String {
        let ids: Vec<String> = branch
            .nodes
            .iter()
            .map(|node| self.nodes[*node].id.to_string())
            .collect();
        let lines: Vec<String> = ids
            .chunks(NUMBERS_A_LINE)
            .map(|ids| ids.join(", "))
            .collect();
        let solid = match branch.solid {
            None => "false".to_owned(),
            Some(StaysSolid::Ordered) => "true".to_owned(),
            Some(why) => format!("true # {why}"),
        };
        format!(
            "\n[[branch]]\nnodes = [{}]\nsolid = {solid}\n",
            lines.join(",\n         ")
        )
    }

    /// Reads a skeleton from the text of a `skeleton.toml`; messages call it `file`.
    ///
    /// # Errors
    /// The text is no such file, or what it says is no skeleton: one piece of nodes and branches
    /// that meet at their ends only. Rings are allowed; [`Skeleton::rings`] finds them.
    pub fn from_toml(file: &str, text: &str) -> Result<Self, TextFault> {
        check_head(file, text)?;
        let read: Text = toml_text::read(file, text)?;
        parse(&read).map_err(|fault| TextFault {
            place: Place::of_byte(file, text, fault.span.start),
            message: fault.message,
        })
    }
}

fn parse(text: &Text) -> Result<Skeleton, Fault> {
    check_kind(text)?;
    let nodes = parse_nodes(text)?;
    let index: BTreeMap<u32, usize> = nodes.iter().zip(0..).map(|(n, i)| (n.id, i)).collect();
    let find = |id: u32, span: Range<usize>| {
        index.get(&id).copied().ok_or_else(|| Fault {
            span,
            message: format!(
                "there is no node {id}; remedy: add it below [nodes], or name another"
            ),
        })
    };
    let mut branches = Vec::new();
    for branch in &text.branch {
        let ids = branch.nodes.get_ref().iter();
        let found: Result<Vec<usize>, Fault> =
            ids.map(|id| find(*id.get_ref(), id.span())).collect();
        branches.push(Branch {
            nodes: found?,
            solid: branch.solid.then_some(StaysSolid::Ordered),
        });
    }
    let mut skeleton = Skeleton {
        root: find(*text.root.get_ref(), text.root.span())?,
        nodes,
        branches,
        open: Vec::new(),
    };
    check_branches(text, &skeleton)?;
    for link in &text.open {
        let ends = link.get_ref().map(|id| find(id, link.span()));
        let [a, b] = ends;
        skeleton.open.push([a?, b?]);
    }
    check_open(text, &skeleton)?;
    check_pieces(text, &skeleton)?;
    Ok(skeleton)
}

/// Refuses a file of another kind by its kind, and not by the keys that it has.
fn check_head(file: &str, text: &str) -> Result<(), TextFault> {
    let Ok(Head { kind }) = toml::from_str(text) else {
        return Ok(());
    };
    if kind.get_ref() == KIND {
        return Ok(());
    }
    let found = kind.get_ref();
    Err(TextFault {
        place: Place::of_byte(file, text, kind.span().start),
        message: format!("this is a file of kind \"{found}\"; remedy: give a skeleton"),
    })
}

fn check_kind(text: &Text) -> Result<(), Fault> {
    let schema = *text.schema.get_ref();
    if schema != SCHEMA {
        let message = format!(
            "schema {schema} is unknown; remedy: write the skeleton again with this program, which \
             knows schema {SCHEMA}"
        );
        return Err(Fault::at(&text.schema, message));
    }
    Ok(())
}

fn parse_nodes(text: &Text) -> Result<Vec<Node>, Fault> {
    let entries = text.nodes.get_ref();
    if entries.is_empty() || entries.len() > MOST_NODES {
        let message = format!(
            "there are {} nodes; remedy: give 1 to {MOST_NODES} of them",
            entries.len()
        );
        return Err(Fault::at(&text.nodes, message));
    }
    let mut nodes = Vec::new();
    for (key, numbers) in entries {
        let id = key.get_ref().parse().ok();
        let id = id.filter(|id: &u32| id.to_string() == *key.get_ref());
        let id = id.ok_or_else(|| {
            let message = "a node is named by a whole number; remedy: write 12 = [x, y, z, radius]";
            Fault::at(key, message.to_owned())
        })?;
        nodes.push(parse_node(id, numbers)?);
    }
    nodes.sort_by_key(|node| node.id);
    Ok(nodes)
}

fn parse_node(id: u32, numbers: &Spanned<[f64; 4]>) -> Result<Node, Fault> {
    let [x, y, z, radius_mm] = *numbers.get_ref();
    // NaN lies in no range.
    let is_place = [x, y, z].iter().all(|mm| mm.abs() <= MOST_MM);
    let is_radius = radius_mm > 0.0 && radius_mm <= MOST_MM;
    if is_place && is_radius {
        let at = Point::new(x, y, z);
        return Ok(Node { id, at, radius_mm });
    }
    let what = if is_place { "radius" } else { "place" };
    let message = format!(
        "the {what} of node {id} is out of range; remedy: give [x, y, z, radius] in mm, with a \
         radius above zero and no number beyond {MOST_MM}"
    );
    Err(Fault::at(numbers, message))
}

/// Refuses branches that are no paths, or meet elsewhere than at their ends.
fn check_branches(text: &Text, skeleton: &Skeleton) -> Result<(), Fault> {
    let mut inner_of = vec![None; skeleton.nodes.len()];
    let mut end_of = vec![None; skeleton.nodes.len()];
    let branches = text.branch.iter().zip(&skeleton.branches).zip(1..);
    for ((written, branch), number) in branches {
        if branch.nodes.len() < 2 {
            let message =
                "a branch has two nodes or more; remedy: add a node, or remove the branch";
            return Err(Fault::at(&written.nodes, message.to_owned()));
        }
        check_steps(written, branch, skeleton)?;
        let last = branch.nodes.len() - 1;
        for (at, node) in branch.nodes.iter().enumerate() {
            let is_inner = at > 0 && at < last;
            let clash = if is_inner {
                inner_of[*node].or(end_of[*node])
            } else {
                inner_of[*node]
            };
            if let Some(other) = clash {
                return Err(shared_node(written, at, [other, number]));
            }
            let owner = if is_inner { &mut inner_of } else { &mut end_of };
            owner[*node] = Some(number);
        }
    }
    check_doubles(text, skeleton)
}

/// Refuses steps of no length.
fn check_steps(written: &BranchText, branch: &Branch, skeleton: &Skeleton) -> Result<(), Fault> {
    let ids = written.nodes.get_ref();
    for (step, id) in branch.nodes.windows(2).zip(&ids[1..]) {
        let [a, b] = [step[0], step[1]].map(|node| &skeleton.nodes[node]);
        if (a.at - b.at).norm() <= f64::EPSILON * (1.0 + a.at.coords.norm()) {
            let message = format!(
                "nodes {} and {} lie at one place; remedy: move one of them, or leave it out of the \
                 branch",
                a.id, b.id
            );
            return Err(Fault::at(id, message));
        }
    }
    Ok(())
}

fn shared_node(written: &BranchText, at: usize, [other, number]: [usize; 2]) -> Fault {
    let id = &written.nodes.get_ref()[at];
    let node = id.get_ref();
    let message = if other == number {
        format!("the branch passes node {node} twice; remedy: make two branches of it")
    } else {
        format!(
            "node {node} lies in branch {other} too, and not at an end of both; remedy: end \
             branches at the nodes in which they meet"
        )
    };
    Fault::at(id, message)
}

/// Refuses two branches that are one straight link between the same two nodes.
fn check_doubles(text: &Text, skeleton: &Skeleton) -> Result<(), Fault> {
    let mut seen = BTreeMap::new();
    let branches = text.branch.iter().zip(&skeleton.branches).zip(1..);
    for ((written, branch), number) in branches {
        for step in branch.nodes.windows(2) {
            let link = [step[0].min(step[1]), step[0].max(step[1])];
            if let Some(other) = seen.insert(link, number) {
                let [a, b] = link.map(|node| skeleton.nodes[node].id);
                let message = format!(
                    "nodes {a} and {b} are linked in branch {other} too; remedy: remove one, or add \
                     a node between them"
                );
                return Err(Fault::at(&written.nodes, message));
            }
        }
    }
    Ok(())
}

fn check_open(text: &Text, skeleton: &Skeleton) -> Result<(), Fault> {
    for (written, [a, b]) in text.open.iter().zip(&skeleton.open) {
        if !skeleton
            .links()
            .any(|link| link == [*a, *b] || link == [*b, *a])
        {
            let [a, b] = written.get_ref();
            let message = format!(
                "nodes {a} and {b} are not neighbours in a branch; remedy: name two that are"
            );
            return Err(Fault::at(written, message));
        }
    }
    Ok(())
}

/// Refuses nodes that no way leads to from the root.
fn check_pieces(text: &Text, skeleton: &Skeleton) -> Result<(), Fault> {
    let is_reached = skeleton.reached();
    let Some(lost) = is_reached.iter().position(|is_reached| !is_reached) else {
        return Ok(());
    };
    let [lost, root] = [lost, skeleton.root].map(|node| skeleton.nodes[node].id);
    let message = format!(
        "no way leads from the root {root} to node {lost}; remedy: join them by a branch, remove \
         node {lost}, or cut fewer links with open"
    );
    let key = text.nodes.get_ref().keys();
    let key = key
        .into_iter()
        .find(|key| *key.get_ref() == lost.to_string());
    let span = key.map_or(text.nodes.span(), Spanned::span);
    Err(Fault { span, message })
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// A Y of four nodes.
    const Y: &str = "kind = \"skeleton\"\nschema = 1\nroot = 2\nopen = []\n\
        [nodes]\n1 = [0, 0, 0, 4]\n2 = [0, 0, 20, 5]\n3 = [9, 0, 30, 3]\n4 = [-9, 0, 30, 3]\n\
        5 = [0, 0, 10, 4]\n\
        [[branch]]\nnodes = [1, 5, 2]\nsolid = true\n\
        [[branch]]\nnodes = [2, 3]\n[[branch]]\nnodes = [2, 4]\n";

    /// Texts that spoil the Y, and words of the message.
    const BROKEN: [(&str, &str, &str); 25] = [
        (
            "kind = \"skeleton\"",
            "kind = \"telescope\"",
            "give a skeleton",
        ),
        ("kind = \"skeleton\"\n", "", "missing field `kind`"),
        ("schema = 1", "schema = 2", "knows schema 1"),
        ("root = 2", "root = 9", "there is no node 9"),
        ("root = 2", "root = -1", "invalid value"),
        ("root = 2", "rot = 2", "did you mean `root`"),
        ("open = []", "open = [[1, 3]]", "not neighbours"),
        ("open = []", "open = [[1, 9]]", "there is no node 9"),
        ("open = []", "open = [[1, 5]]", "cut fewer links"),
        ("open = []", "open = [1, 5]", "invalid type"),
        ("1 = [0, 0, 0, 4]", "1 = [0, 0, 0, 0]", "radius of node 1"),
        ("1 = [0, 0, 0, 4]", "1 = [0, 0, 0, -4]", "radius of node 1"),
        ("1 = [0, 0, 0, 4]", "1 = [0, nan, 0, 4]", "place of node 1"),
        ("1 = [0, 0, 0, 4]", "1 = [0, 0, 0, inf]", "radius of node 1"),
        ("1 = [0, 0, 0, 4]", "1 = [0, 0, 0]", "invalid length"),
        ("1 = [0, 0, 0, 4]", "01 = [0, 0, 0, 4]", "whole number"),
        ("1 = [0, 0, 0, 4]", "one = [0, 0, 0, 4]", "whole number"),
        ("5 = [0, 0, 10, 4]", "5 = [0, 0, 0, 4]", "lie at one place"),
        (
            "5 = [0, 0, 10, 4]",
            "5 = [0, 0, 10, 4]\n6 = [1, 1, 1, 1]",
            "to node 6",
        ),
        ("nodes = [2, 4]", "nodes = [2]", "two nodes or more"),
        ("nodes = [2, 4]", "nodes = [2, 7]", "there is no node 7"),
        ("nodes = [2, 4]", "nodes = [5, 4]", "lies in branch 1 too"),
        (
            "nodes = [2, 4]",
            "nodes = [2, 4]\n[[branch]]\nnodes = [4, 2]",
            "linked in branch 3 too",
        ),
        ("nodes = [2, 4]", "nodes = [2, 4, 2, 3]", "remedy"),
        ("solid = true", "solid = \"yes\"", "invalid type"),
    ];

    #[test]
    fn a_skeleton_reads_as_a_person_would_write_it() {
        let skeleton = Skeleton::from_toml("y.toml", Y).unwrap();
        assert_eq!((skeleton.nodes.len(), skeleton.root), (5, 1));
        assert_eq!(skeleton.branches[0].nodes, [0, 4, 1]);
        assert_eq!(skeleton.branches[0].solid, Some(StaysSolid::Ordered));
        assert_eq!(skeleton.branches[1].solid, None);
        let text = skeleton.to_toml("y\nx");
        assert_eq!(Skeleton::from_toml("again.toml", &text).unwrap(), skeleton);
    }

    #[test]
    fn every_broken_skeleton_is_refused_with_its_place_and_its_reason() {
        for (from, to, reason) in BROKEN {
            assert!(Y.contains(from), "{from}");
            let refused = Skeleton::from_toml("y.toml", &Y.replacen(from, to, 1));
            let message = refused.unwrap_err().to_string();
            let is_placed = message.starts_with("y.toml:");
            assert!(
                is_placed && message.contains(reason),
                "{from} → {to}: {message}"
            );
        }
    }

    #[test]
    fn a_lone_node_is_a_skeleton_without_branches() {
        let point = "kind = \"skeleton\"\nschema = 1\nroot = 3\n[nodes]\n3 = [1, 2, 3, 4]\n";
        let skeleton = Skeleton::from_toml("point.toml", point).unwrap();
        assert!(skeleton.branches.is_empty() && skeleton.rings().is_empty());
    }

    proptest! {
        #[test]
        fn no_random_graph_brings_the_reader_or_the_limbs_down(
            places in prop::collection::vec(
                ([-50.0..50.0f64, -50.0..50.0, -50.0..50.0], 0.1..9.0f64),
                1..9,
            ),
            branches in prop::collection::vec(prop::collection::vec(1..10u32, 0..5), 0..7),
            open in prop::collection::vec([1..10u32, 1..10u32], 0..3),
            root in 1..10u32,
        ) {
            let mut text = format!("kind = \"skeleton\"\nschema = 1\nroot = {root}\nopen = {open:?}\n[nodes]\n");
            for (id, ([x, y, z], radius)) in (1..).zip(&places) {
                text += &format!("{id} = [{x:?}, {y:?}, {z:?}, {radius:?}]\n");
            }
            for branch in &branches {
                text += &format!("[[branch]]\nnodes = {branch:?}\n");
            }
            let sizes = crate::skeleton::ShellSizes { least_radius_mm: 1.0, pitch_mm: 1.0 };
            if let Ok(skeleton) = Skeleton::from_toml("r.toml", &text) {
                let rings = skeleton.rings().len();
                prop_assert_eq!(crate::skeleton::Limbs::of(&skeleton, &sizes).is_err(), rings > 0);
                let again = Skeleton::from_toml("r.toml", &skeleton.to_toml("r"));
                prop_assert_eq!(again.map(|again| again.branches), Ok(skeleton.branches));
            }
        }

        #[test]
        fn random_trees_have_limbs_whose_radii_fall_outwards(
            nodes in prop::collection::vec(
                (0..100usize, [-20.0..20.0f64, -20.0..20.0, -20.0..20.0], 0.5..9.0f64),
                2..20,
            ),
        ) {
            let mut text = "kind = \"skeleton\"\nschema = 1\nroot = 1\n".to_owned();
            let mut branches = String::new();
            text += "[nodes]\n";
            for (index, (parent, [x, y, z], radius)) in nodes.iter().enumerate() {
                text += &format!("{} = [{x:?}, {y:?}, {z:?}, {radius:?}]\n", index + 1);
                if index > 0 {
                    branches += &format!("[[branch]]\nnodes = [{}, {}]\n", parent % index + 1, index + 1);
                }
            }
            let skeleton = Skeleton::from_toml("t.toml", &(text + &branches)).unwrap();
            let sizes = crate::skeleton::ShellSizes { least_radius_mm: 1.0, pitch_mm: 1.0 };
            let limbs = crate::skeleton::Limbs::of(&skeleton, &sizes).unwrap();
            for chain in &limbs.chains {
                prop_assert!(chain.radii_mm.is_sorted_by(|a, b| a >= b));
                prop_assert!(chain.most_shells(&sizes) >= 2 && chain.free_mm() > 0.0);
                prop_assert!(chain.from < limbs.junctures.len());
            }
            let parents = limbs.junctures.iter().filter(|juncture| juncture.parent.is_none());
            prop_assert_eq!(parents.count(), 1);
        }
    }
}
