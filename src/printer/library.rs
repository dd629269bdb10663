//! The built-in profiles.

/// The text of a profile with its id and the name of its file.
#[derive(Debug, Clone, Copy)]
pub(super) struct Profile<'a> {
    pub id: &'a str,
    pub file: &'a str,
    pub text: &'a str,
}

/// A set of profiles that may refer to each other by id; each list is in the order of the ids.
#[derive(Debug, Clone, Copy)]
pub(super) struct Library<'a> {
    pub printers: &'a [Profile<'a>],
    pub processes: &'a [Profile<'a>],
    pub materials: &'a [Profile<'a>],
}

macro_rules! built_in {
    ($folder:literal: $($id:literal)*) => {
        &[$(Profile {
            id: $id,
            file: concat!("profiles/", $folder, "/", $id, ".toml"),
            text: include_str!(concat!("../../profiles/", $folder, "/", $id, ".toml")),
        }),*]
    };
}

/// The profiles that come with the program.
pub(super) const BUILT_IN: Library<'static> = Library {
    printers: built_in!("printers":
        "bambu-x1c" "elegoo-mars-5-ultra" "elegoo-saturn-4-ultra" "eos-p396" "formlabs-form3"
        "formlabs-form4" "formlabs-fuse1" "hp-mjf-5200" "objet-connex350" "projet-mjp-2500"
        "prusa-mk3s" "prusa-mk4" "prusa-sl1s" "ultimaker-s5"),
    processes: built_in!("processes": "fdm" "mjf" "mjp" "polyjet" "sla" "sls"),
    materials: built_in!("materials":
        "abs" "abs-ultimaker" "asa" "formlabs-nylon-12" "formlabs-standard" "hp-pa12" "pa2200" "pc"
        "petg" "pla" "resin" "vero-white" "visijet-m2r"),
};

/// Ending of the file name of a profile.
pub(super) const PROFILE_ENDING: &str = ".toml";

/// Finds the profile of an id.
pub(super) fn by_id<'a>(profiles: &'a [Profile<'a>], id: &str) -> Option<&'a Profile<'a>> {
    profiles.iter().find(|profile| profile.id == id)
}

/// Lists the ids of the profiles, in order.
pub(super) fn ids<'a>(profiles: &[Profile<'a>]) -> Vec<&'a str> {
    profiles.iter().map(|profile| profile.id).collect()
}
