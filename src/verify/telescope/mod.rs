//! The judge of telescopes: from the written parts, their poses and the keys of the motion alone.
//!
//! [`verify_telescope`] reads a kit from its folder, [`judge_telescope`] measures evidence in
//! memory. Nothing of the code that makes telescopes is seen here: shells are moved by the judge's
//! own screws.

mod ballast;
mod checks;
mod contact;
mod course;
mod deviation;
mod divided;
mod evidence;
mod facts;
mod juncture;
mod motion;
mod network;
mod network_checks;
mod network_ends;
mod network_facts;
mod network_model;
mod network_reading;
mod network_seats;
mod network_standing;
mod packages;
mod pinned;
mod pose;
mod poses;
mod promise;
mod reading;
mod scene;
mod shells;
mod standing;
mod stops;
mod surfaces;

pub use checks::telescope_checks;
pub use divided::DividedFacts;
pub use evidence::TelescopeEvidence;
pub use facts::{TelescopeFacts, judge_telescope};
pub use juncture::{DividedPromise, JunctureJointPromise, JuncturePartPromise, JuncturePromise};
pub use motion::{JointMotion, MotionKey, ShellMotion, TelescopeMotion};
pub use network::{
    LimbPromise, NETWORK_SCHEMA, NetworkEvidence, NetworkKey, NetworkMotion, NetworkPromise,
};
pub use network_checks::network_checks;
pub use network_facts::{NetworkFacts, judge_network};
pub use network_model::ModelFacts;
pub use network_reading::{limb_curve_file, verify_telescope};

pub use network_standing::NetworkStanding;
pub use packages::{NESTED_FILE, NESTED_NAME};
pub use pose::{
    PoseMotion, PosePromise, PoseState, PoseText, PoseTextJoint, PoseTipPromise, PosesFacts,
    REACH_LIMIT_MM,
};
pub use promise::{
    BalancePromise, DeviationPromise, JointPromise, TelescopeBallast, TelescopePartPromise,
    TelescopePromise,
};
pub use reading::{CURVE_FILE, MOTION_FILE, TelescopeVerifyError, asked_points};
pub use scene::{MOTION_SCENE_FILE, OPENING};
