//! Cracks in a scene: what is refused, how they are carried, grow, stop, and are saved.

use fissure_scene::{
    ContactLaw, CrackError, CrackLine, CrackSettings, End, EndState, Growth, GrowthCriterion,
    GrowthError, PersistError, Plane, Scene, SceneError, VertexMotion, grow_cracks,
};
use nalgebra::Vector2;

fn scene(cracks: &[(&str, &[[f64; 2]])]) -> Scene<2> {
    let mut scene = Scene::plane(Plane::Strain { thickness: 1.0 });
    for (name, points) in cracks {
        scene
            .crack(name, points, CrackSettings::default())
            .expect("a crack");
    }
    scene
}

/// Straight on by a length, for cracks of one name.
struct Ahead(&'static str, f64);

impl GrowthCriterion for Ahead {
    fn growth(
        &mut self,
        scene: &Scene<2>,
        crack: usize,
        end: End,
    ) -> Result<Option<Growth>, GrowthError> {
        let crack = &scene.cracks()[crack];
        let direction = crack.tip(end).1;
        Ok((crack.name() == self.0).then_some(Growth {
            direction,
            length: self.1,
        }))
    }
}

#[test]
fn what_is_no_crack_is_refused() {
    let mut scene = scene(&[("a", &[[0.0, 0.0], [1.0, 0.0]])]);
    let settings = CrackSettings::default();
    let edits = scene.edits();
    let taken = scene.crack("a", &[[0.0, 1.0], [1.0, 1.0]], settings);
    assert!(matches!(taken, Err(SceneError::NameTaken { .. })));
    let folded = scene.crack("b", &[[0.0, 1.0], [1.0, 1.0], [0.0, 1.0]], settings);
    assert!(matches!(
        folded,
        Err(SceneError::Crack { crack, source: CrackError::NotSimple { first: 0, second: 1 } }) if crack == "b"
    ));
    for friction in [-0.1, f64::NAN, f64::INFINITY] {
        let contact = ContactLaw::Coulomb { friction };
        let rough = scene.crack(
            "c",
            &[[0.0, 1.0], [1.0, 1.0]],
            CrackSettings {
                contact,
                ..settings
            },
        );
        assert!(matches!(
            rough,
            Err(SceneError::Crack {
                source: CrackError::Parameter { .. },
                ..
            })
        ));
    }
    let first = EndState::Arrested { by: 1 };
    let held = scene.crack(
        "d",
        &[[0.0, 1.0], [1.0, 1.0]],
        CrackSettings { first, ..settings },
    );
    assert!(matches!(
        held,
        Err(SceneError::Crack {
            source: CrackError::Unknown {
                crack: 1,
                cracks: 1
            },
            ..
        })
    ));
    assert_eq!((scene.cracks().len(), scene.edits()), (1, edits));
}

#[test]
fn ends_frames_and_boxes() {
    let settings = CrackSettings {
        first: EndState::Mouth,
        ..Default::default()
    };
    let crack = CrackLine::new("notch", &[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0]], settings).unwrap();
    assert_eq!(crack.tips().collect::<Vec<_>>(), [End::Last]);
    assert_eq!(crack.tip(End::Last), (Vector2::new(2.0, 1.0), Vector2::y()));
    assert_eq!(crack.tip(End::First), (Vector2::zeros(), -Vector2::x()));
    assert_eq!(
        crack.behind(End::Last, 1.5),
        (Vector2::new(1.5, 0.0), Vector2::x())
    );
    assert_eq!(
        crack.behind(End::First, 2.5),
        (Vector2::new(2.0, 0.5), -Vector2::y())
    );
    assert_eq!(crack.behind(End::Last, 9.0).0, Vector2::zeros());
    let half = Vector2::new(0.5, 0.5);
    assert!(crack.tip_in_box(&Vector2::new(2.4, 1.4), &half));
    assert!(!crack.tip_in_box(&Vector2::new(2.5, 1.0), &half)); // on the side of the box
    assert!(!crack.tip_in_box(&Vector2::zeros(), &half)); // a mouth
}

#[test]
fn a_crack_is_carried_with_its_jump() {
    let mut crack =
        CrackLine::new("c", &[[0.0, 0.0], [1.0, 0.0]], CrackSettings::default()).unwrap();
    for _ in 0..3 {
        let carried = crack.carry(|_, x| VertexMotion {
            displacement: Vector2::new(0.0, 0.1 * x.x),
            jump: Vector2::new(0.0, 0.01 * (1.0 - x.x)),
        });
        carried.unwrap();
    }
    assert!((crack.line().points()[1] - Vector2::new(1.0, 0.3)).norm() < 1e-15);
    assert_eq!(crack.placed()[1], Vector2::x());
    assert!(
        (crack.jump_behind(End::Last, 0.5 * crack.line().length()) - Vector2::y() * 0.015).norm()
            < 1e-15
    );
    let before = crack.clone();
    let motion = |displacement: Vector2<f64>, jump: Vector2<f64>| {
        move |_: usize, _: &Vector2<f64>| VertexMotion { displacement, jump }
    };
    let nan = Vector2::new(f64::NAN, 0.0);
    for (displacement, jump) in [(nan, Vector2::zeros()), (Vector2::zeros(), nan)] {
        let refused = crack.carry(motion(displacement, jump));
        assert_eq!(refused, Err(CrackError::NotFinite { vertex: 0 }));
    }
    let collapsed = crack.carry(|_, x| VertexMotion {
        displacement: -x,
        jump: Vector2::zeros(),
    });
    assert_eq!(collapsed, Err(CrackError::NoLength { segment: 0 }));
    assert_eq!(crack, before);
}

#[test]
fn tips_grow_stop_at_a_crack_and_may_start_again() {
    let mut scene = scene(&[
        ("runner", &[[0.0, 0.0], [1.0, 0.0]]),
        ("far", &[[3.0, -1.0], [3.0, 1.0]]),
        ("near", &[[2.0, -1.0], [2.2, 1.0]]),
    ]);
    let edits = scene.edits();
    let grown = grow_cracks(&mut scene, &mut Ahead("runner", 5.0)).unwrap();
    assert!(scene.edits() > edits);
    assert_eq!(grown.len(), 2);
    assert_eq!(
        (grown[0].end, grown[0].arrested_by, grown[0].length),
        (End::First, None, 5.0)
    );
    assert_eq!((grown[1].end, grown[1].arrested_by), (End::Last, Some(2)));
    assert!((grown[1].tip - Vector2::new(2.1, 0.0)).norm() < 1e-15);
    let runner = &scene.cracks()[0];
    assert_eq!(runner.end(End::Last), EndState::Arrested { by: 2 });
    assert_eq!(runner.line().points()[0], Vector2::new(-5.0, 0.0));
    assert_eq!((runner.placed().len(), runner.jump().len()), (4, 4));
    // The arrested tip stays.
    let grown = grow_cracks(&mut scene, &mut Ahead("runner", 1.0)).unwrap();
    assert_eq!(
        grown.iter().map(|g| g.end).collect::<Vec<_>>(),
        [End::First]
    );
    assert_eq!(
        scene.grow_crack(0, End::Last, Vector2::new(9.0, 0.0)),
        Err(CrackError::NoTip)
    );
    // Those of the crack it ran into do not.
    let grown = grow_cracks(&mut scene, &mut Ahead("near", 0.5)).unwrap();
    assert_eq!(grown.len(), 2);
    scene.cracks_mut()[0].set_end(End::Last, EndState::Tip);
    assert_eq!(scene.cracks()[0].tips().count(), 2);
}

#[test]
fn a_refused_growth_changes_nothing() {
    let mut scene = scene(&[("hook", &[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0]])]);
    let before = scene.cracks()[0].clone();
    for (to, error) in [
        (
            Vector2::new(1.0, -1.0),
            CrackError::NotSimple {
                first: 0,
                second: 3,
            },
        ),
        (
            Vector2::new(1.5, 1.0),
            CrackError::NotSimple {
                first: 2,
                second: 3,
            },
        ),
        (Vector2::new(1.0, 1.0), CrackError::NoLength { segment: 3 }),
        (
            Vector2::new(f64::INFINITY, 1.0),
            CrackError::NotFinite { vertex: 4 },
        ),
    ] {
        assert_eq!(scene.grow_crack(0, End::Last, to), Err(error));
    }
    let absent = scene.grow_crack(1, End::Last, Vector2::zeros());
    assert_eq!(
        absent,
        Err(CrackError::Unknown {
            crack: 1,
            cracks: 1
        })
    );
    assert_eq!(scene.cracks()[0], before);
}

#[test]
fn cracks_are_saved_and_restored() {
    let built = || {
        scene(&[
            ("a", &[[0.0, 0.0], [1.0, 0.0]]),
            ("b", &[[3.0, -1.0], [3.0, 1.0]]),
        ])
    };
    let mut grown = built();
    grow_cracks(&mut grown, &mut Ahead("a", 2.5)).unwrap();
    grown.cracks_mut()[1]
        .carry(|_, x| VertexMotion {
            displacement: x * 0.1,
            jump: Vector2::y(),
        })
        .unwrap();
    let sections = grown.save().unwrap();
    let mut restored = built();
    restored.restore(&sections).unwrap();
    assert_eq!(restored.cracks(), grown.cracks());
    let other = scene(&[
        ("a", &[[0.0, 0.0], [1.0, 0.0]]),
        ("c", &[[3.0, -1.0], [3.0, 1.0]]),
    ])
    .restore(&sections);
    assert!(matches!(other, Err(PersistError::CrackName { found, .. }) if found == "b"));
    let fewer = scene(&[("a", &[[0.0, 0.0], [1.0, 0.0]])]).restore(&sections);
    assert!(matches!(
        fewer,
        Err(PersistError::Mismatch {
            found: 2,
            expected: 1,
            ..
        })
    ));
    let none = scene(&[]).restore(&sections);
    assert!(matches!(none, Err(PersistError::Mismatch { .. })));
    // A scene without cracks writes nothing of them, and one with cracks asks for them.
    let bare = scene(&[]).save().unwrap();
    assert!(bare.iter().all(|section| section.name != "cracks"));
    assert!(matches!(
        built().restore(&bare),
        Err(PersistError::Missing { .. })
    ));
}
