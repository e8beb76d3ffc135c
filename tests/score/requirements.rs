//! Verdicts, and work that ends early.

use super::{cuboid, models, score, truth, with_thresholds};
use nurbs_hausdorff::{Engine, ScoreNumber, ScoreOptions};
use std::collections::BTreeMap;

fn least(number: ScoreNumber, bound: f64) -> BTreeMap<ScoreNumber, f64> {
    BTreeMap::from([(number, bound)])
}

#[test]
fn requirements_are_met_or_missed() {
    let deep = models::prepared(&cuboid([0.0; 3], [2.0, 3.0, 4.5]));
    let options = with_thresholds(&[0.2]);
    // The Hausdorff distance is 0.5, and the smaller volume 8/9 of the larger.
    let met = ScoreOptions {
        at_most: BTreeMap::from([(ScoreNumber::Hausdorff, 0.51), (ScoreNumber::Chamfer, 0.2)]),
        at_least: BTreeMap::from([
            (ScoreNumber::VolumeRatio, 0.88),
            (ScoreNumber::Valid, 1.0),
            (ScoreNumber::F1, 0.5),
        ]),
        ..options.clone()
    };
    let found = score(&deep, &truth(), &met);
    assert_eq!((found.met, found.ended_early, found.requirements.len()), (Some(true), false, 5));
    for requirement in &found.requirements {
        assert_eq!(requirement.met, Some(true), "{requirement:?}");
    }
    let missed = |number: ScoreNumber, options: ScoreOptions| {
        let found = score(&deep, &truth(), &options);
        assert_eq!((found.met, found.ended_early), (Some(false), true), "{number}");
        assert_eq!(found.requirements[0].met, Some(false), "{number}");
    };
    for (number, bound) in [(ScoreNumber::Hausdorff, 0.49), (ScoreNumber::ExtentDifference, 0.4)] {
        missed(number, ScoreOptions { at_most: least(number, bound), ..options.clone() });
    }
    for (number, bound) in [(ScoreNumber::VolumeRatio, 0.9), (ScoreNumber::F1, 0.99)] {
        missed(number, ScoreOptions { at_least: least(number, bound), ..options.clone() });
    }
}

/// Without a requirement nothing is met or missed, however wide the intervals are.
#[test]
fn what_is_not_required_is_not_judged() {
    let found = score(&truth(), &truth(), &ScoreOptions { max_cells: 1, ..ScoreOptions::default() });
    assert_eq!((found.met, found.ended_early, found.requirements.len()), (None, false, 0));
}

/// What is missed by facts takes no search, and what is missed by statistics no distance.
#[test]
fn a_missed_requirement_ends_the_work() {
    let deep = models::prepared(&cuboid([0.0; 3], [2.0, 3.0, 4.5]));
    let with = |number, bound| ScoreOptions { at_least: least(number, bound), ..with_thresholds(&[0.2]) };
    let by_facts = score(&deep, &truth(), &with(ScoreNumber::VolumeRatio, 0.99));
    assert!(by_facts.ended_early && !by_facts.converged);
    assert!(by_facts.forward.is_none() && by_facts.hausdorff.is_none() && by_facts.thresholds.is_empty());
    let by_surfaces = score(&deep, &truth(), &with(ScoreNumber::F1, 0.99));
    assert!(by_surfaces.forward.is_some() && by_surfaces.hausdorff.is_none());
    // Precision alone decides: the truth's points were not looked at.
    assert!(by_surfaces.reverse.is_none(), "{by_surfaces:?}");
    let f1 = by_surfaces.requirements[0];
    assert!(f1.met == Some(false) && f1.found.upper < 0.99, "{f1:?}");
    let balls = [1.5, 1.0].map(|radius| {
        models::prepared(&nurbs_hausdorff::shapes::sphere(nurbs_hausdorff::DVec3::ZERO, radius).unwrap())
    });
    let by_iou = score(&balls[0], &balls[1], &with(ScoreNumber::Iou, 0.5));
    assert!(by_iou.iou.is_some() && by_iou.forward.is_none() && by_iou.met == Some(false), "{by_iou:?}");
    // One that only asks for the distance has it first.
    let most = ScoreOptions { at_most: least(ScoreNumber::Hausdorff, 0.1), ..with_thresholds(&[0.2]) };
    let by_distance = score(&deep, &truth(), &most);
    assert!(by_distance.hausdorff.is_some() && by_distance.forward.is_none() && by_distance.ended_early);
}

/// An open candidate has no volume, so that nothing is known of the ratio.
#[test]
fn what_is_not_there_is_not_decided() {
    let mut faces = models::faces(&cuboid([0.0; 3], super::SIZE));
    faces.pop();
    let open = models::prepared(&models::of(faces));
    let options = ScoreOptions { at_least: least(ScoreNumber::VolumeRatio, 0.5), ..ScoreOptions::default() };
    let found = score(&open, &truth(), &options);
    assert_eq!((found.met, found.ended_early), (None, false));
}

#[test]
fn options_out_of_range_are_refused() {
    let refused = |options: ScoreOptions| {
        let (one, other) = (truth(), truth());
        Engine::cpu().score(&one, &other, &options).wait().unwrap_err().code().to_owned()
    };
    let default = ScoreOptions::default;
    assert_eq!(refused(ScoreOptions { thresholds: vec![-1.0], ..default() }), "OPTION_OUT_OF_RANGE");
    assert_eq!(refused(ScoreOptions { part_tolerance: 0.0, ..default() }), "OPTION_OUT_OF_RANGE");
    assert_eq!(refused(ScoreOptions { limit: Some(0.0), ..default() }), "OPTION_OUT_OF_RANGE");
    assert_eq!(refused(ScoreOptions { max_cells: 0, ..default() }), "OPTION_OUT_OF_RANGE");
    let both = ScoreOptions { tolerance: Some(1.0), relative_tolerance: Some(1.0), ..default() };
    assert_eq!(refused(both), "OPTION_INVALID");
}

/// Options as JSON have the names of requirements as keys.
#[test]
fn options_are_read_by_their_names() {
    let text = r#"{"thresholds": [0.1], "align": "best-fit", "atLeast": {"f1": 0.99, "volumeRatio": 0.9}}"#;
    let options: ScoreOptions = serde_json::from_str(text).unwrap();
    assert_eq!(options.at_least[&ScoreNumber::VolumeRatio], 0.9);
    assert_eq!(options.align, nurbs_hausdorff::ScoreAlignment::BestFit);
    for number in ScoreNumber::ALL {
        assert_eq!(serde_json::to_value(number).unwrap(), number.name());
        assert_eq!(number.name().parse(), Ok(number));
    }
    assert_eq!("volume-ratio".parse(), Ok(ScoreNumber::VolumeRatio));
    assert!("volume".parse::<ScoreNumber>().is_err());
}
