//! The parts of an interval of the search.

use super::*;
use crate::bezier::{LocalDerivativeBounds, extract};
use crate::certified::Cell;
use crate::certified::Operand;
use crate::certified::audit::{Audit, Auditor, CellBound, Lemma};
use crate::closest::Target;
use crate::model::{Model, RigidTransform, SurfaceArrays};
use crate::param_box::ParamBox;

/// How far from the origin the models are, so that rounding is seen.
const AWAY: f64 = 1e6;

/// A model with its patches as they are.
struct Whole {
    target: Target,
    bounds: Vec<LocalDerivativeBounds>,
}

impl Whole {
    /// A unit square at this height.
    fn square(height: f64) -> Self {
        let corners = [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [1.0, 1.0]];
        let square = SurfaceArrays {
            degree: [1, 1],
            knots: [vec![0.0, 0.0, 1.0, 1.0], vec![0.0, 0.0, 1.0, 1.0]],
            counts: [2, 2],
            control_points: corners.map(|[x, y]| [AWAY + x, y, height, 1.0]).to_vec(),
        };
        let target = Target::new(extract(&Model::from_arrays(None, vec![square]).unwrap()).patches);
        let bounds = target.patches.iter().map(|_| LocalDerivativeBounds::new(ParamBox::UNIT)).collect();
        Self { target, bounds }
    }

    fn operand(&self) -> Operand<'_> {
        Operand::new(&self.target, &self.bounds)
    }
}

/// Two parallel squares at distance 1.
fn with_squares(look: impl FnOnce(Pair<'_>)) {
    let [a, b] = [Whole::square(1.0), Whole::square(0.0)];
    look(Pair { a: a.operand(), b: b.operand(), transform: RigidTransform::IDENTITY });
}

fn run(search: &mut BranchAndBound<'_>) -> Stop {
    loop {
        if let Some(stop) = search.advance(1000) {
            search.finish();
            return stop;
        }
    }
}

/// Rounding widens both ends, and slack the upper one, which also is rounded up.
#[test]
fn rounding_and_slack_widen_the_interval() {
    with_squares(|pair| {
        let rounding = point_error(&pair);
        let certificate = closest_point_error(&pair);
        assert!(rounding > 1e-10);
        for slack in [0.0, 0.25] {
            let mut search = BranchAndBound::new(pair, 1.0, None, slack);
            assert_eq!(run(&mut search), Stop::Converged);
            let Interval { lower, upper } = search.interval();
            let lost = slack + 2.0 * rounding + certificate;
            assert!((upper - 1.0 - slack) / rounding >= 0.99, "{upper} with slack {slack}");
            assert!((1.0 - lower) / rounding >= 0.99, "{lower}");
            assert!(upper - lower <= 1.0 + lost);
            assert_eq!(search.goal.reserved_width, lost);
            assert_eq!(search.min_tolerance(), 2.0 * lost);
            // What is requested is the width with all that rounding and slack take.
            assert_eq!(search.tolerance(), 1.0 - lost);
            // Less than twice of that cannot be had: the search stops there.
            assert_eq!(BranchAndBound::new(pair, 1.5 * lost, None, slack).tolerance(), lost);
        }
    });
}

/// A limit is decided by both ends, and is undecided between them.
#[test]
fn a_limit_is_decided_by_the_interval() {
    with_squares(|pair| {
        for slack in [0.0, 0.125] {
            for (limit, within) in [(1.5, Some(true)), (0.5, Some(false))] {
                let mut search = BranchAndBound::new(pair, 1e-3, Some(Limit::exact(limit)), slack);
                run(&mut search);
                assert_eq!(search.within(), within, "{limit}");
            }
            let search = BranchAndBound::new(pair, 1e-3, Some(Limit::exact(1.5)), slack);
            // No node is pruned whose bound does not keep the limit with rounding and slack.
            let threshold = search.prune_threshold();
            assert!(rounded_up(threshold) + slack + search.goal.rounding <= 1.5);
            assert!(threshold > 1.5 - slack - 1.01e-3);
        }
        let between = BranchAndBound {
            frontier: Frontier::new(SearchNode::root(2.0)),
            ..BranchAndBound::new(pair, 1e-3, Some(Limit::exact(1.5)), 0.0)
        };
        assert_eq!(between.within(), None);
        assert_eq!(BranchAndBound::new(pair, 1e-3, None, 0.0).within(), None);
    });
}

/// With a gap the search also decides whether every source keeps the limit: the distance is 1, so that the
/// sources' is from 0.75 to 1.25.
#[test]
fn a_limit_with_a_gap_is_decided_on_both_sides_of_it() {
    with_squares(|pair| {
        for (at, keeps, sources_keep) in [
            (0.74, Some(false), Some(false)),
            (0.76, Some(false), None),
            (1.24, Some(true), None),
            (1.26, Some(true), Some(true)),
        ] {
            let limit = Limit { at, gap: 0.25 };
            let mut search = BranchAndBound::new(pair, 1e-3, Some(limit), 0.0);
            assert_eq!(run(&mut search), Stop::Converged);
            assert_eq!(
                (search.within(), limit.sources_keep(search.interval())),
                (keeps, sources_keep),
                "{at}"
            );
        }
    });
}

/// A search for less than rounding allows stops where the interval is as narrow as it can be requested,
/// although nodes are left, unless a limit is to be decided; a wider interval is searched further.
#[test]
fn a_search_below_rounding_stops_where_the_interval_is_narrow() {
    with_squares(|pair| {
        let lost = BranchAndBound::new(pair, 1.0, None, 0.0).goal.reserved_width;
        for (above, limit, stop) in
            [(0.25, None, Some(Stop::Precision)), (1.5, None, None), (0.25, Some(Limit::exact(1.0)), None)]
        {
            let search = BranchAndBound::new(pair, 0.1 * lost, limit, 0.0);
            let upper = search.incumbent.lower_bound() + above * lost + 0.5 * search.min_tolerance();
            let root = SearchNode { upper, ..SearchNode::root(upper) };
            let mut search = BranchAndBound { frontier: Frontier::new(root), ..search };
            assert_eq!(search.advance_once(1), stop, "{above} {limit:?}");
            assert_eq!(search.work.cells, usize::from(stop.is_none()));
        }
    });
}

/// Nodes that a kernel leaves, for another one or for float64, stay in the interval, and so does
/// what it pruned.
#[test]
fn a_batch_that_returns_stays_in_the_interval() {
    with_squares(|pair| {
        let node = SearchNode { upper: 3.0, ..SearchNode::root(f64::INFINITY) };
        let empty = || BranchAndBound {
            frontier: Frontier::new(SearchNode::root(0.0)),
            ..BranchAndBound::new(pair, 1e-3, None, 0.0)
        };
        for batch in [
            BatchResult { waiting: vec![node], ..BatchResult::default() },
            BatchResult { undecided: vec![node], ..BatchResult::default() },
            BatchResult { dropped: 3.0, ..BatchResult::default() },
        ] {
            let mut search = empty();
            assert!(search.interval().upper < 3.0);
            search.return_batch(batch);
            assert!(search.interval().upper >= 3.0);
        }
    });
}

/// The children of a node cover it: both nodes of the tree below, the patch of a leaf, the parts of
/// a cell, and all domains given.
#[test]
fn children_cover_their_node() {
    let square = |height: f64| {
        let corners = [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [1.0, 1.0]];
        SurfaceArrays {
            degree: [1, 1],
            knots: [vec![0.0, 0.0, 1.0, 1.0], vec![0.0, 0.0, 1.0, 1.0]],
            counts: [2, 2],
            control_points: corners.map(|[x, y]| [x, y, height, 1.0]).to_vec(),
        }
    };
    let model = Model::from_arrays(None, vec![square(0.0), square(1.0)]).unwrap();
    let target = Target::new(extract(&model).patches);
    let bounds: Vec<_> = target.patches.iter().map(|_| LocalDerivativeBounds::new(ParamBox::UNIT)).collect();
    let operand = Operand::new(&target, &bounds);
    let children = |node: &SearchNode| {
        let mut children = Vec::new();
        node.branch(&operand, node.foot, None, &mut children);
        assert!(children.iter().all(|child| child.upper == node.upper && child.level == node.level + 1));
        children
    };
    let nodes = children(&SearchNode::root(3.0));
    let mut patches: Vec<u32> = Vec::new();
    for leaf in nodes.iter().flat_map(children) {
        let Domain::Cell(cell) = leaf.domain else { panic!("a leaf holds a patch") };
        assert!(cell.is_whole());
        patches.push(cell.patch);
        let area = |node: &SearchNode| match node.domain {
            Domain::Cell(part) => part.half[0] * part.half[1],
            _ => 0.0,
        };
        assert_eq!(children(&leaf).iter().map(area).sum::<f64>(), cell.half[0] * cell.half[1]);
    }
    patches.sort_unstable();
    assert_eq!(patches, [0, 1]);
    let (node, mut given) = (SearchNode::root(3.0), Vec::new());
    node.push_children(nodes.iter().map(|node| node.domain), node.foot, &mut given);
    assert_eq!(given.len(), 2);
    assert!(given.iter().all(|child| child.upper == 3.0 && child.level == 1));
}

/// Past its deadline a search bounds nothing and loses nothing.
#[test]
fn a_deadline_leaves_the_nodes() {
    with_squares(|pair| {
        let mut search = BranchAndBound {
            frontier: Frontier::new(SearchNode::root(2.0)),
            ..BranchAndBound::new(pair, 1e-3, None, 0.0)
        };
        search.stop_at(Instant::now());
        let before = search.interval();
        assert_eq!(search.advance(1000), None);
        assert_eq!((search.work().cells, search.interval(), search.waiting()), (0, before, 1));
    });
}

/// A bound of one cell, whose points all are 1 away.
fn bound_of(upper: f64, lemma: Lemma) -> CellBound {
    let cell = Cell { patch: 0, center: [0.25, 0.5], half: [0.25, 0.5] };
    CellBound { cell, upper, lemma, foot: Foot::start(0, [0.5; 2]) }
}

/// A bound that is attained is not refuted, however little is left, and one that is less by more than the width of
/// the certificate is.
#[test]
fn an_audit_refutes_what_is_less_than_the_distance() {
    with_squares(|pair| {
        let search = BranchAndBound::new(pair, 1e-3, None, 0.0);
        let auditor =
            Auditor { pair: &search.pair, nearest: &search.nearest, rounding: search.goal.rounding };
        assert_eq!(auditor.cell(&bound_of(1.0, Lemma::Heights), 8), None);
        assert_eq!(auditor.cell(&bound_of(1.0 - 0.5 * search.goal.rounding, Lemma::Heights), 8), None);
        let refutation = auditor.cell(&bound_of(0.99, Lemma::Heights), 8).unwrap();
        assert_eq!((refutation.lemma, refutation.patch, refutation.upper), (Lemma::Heights, 0, 0.99));
        assert!(refutation.distance > 0.99 && refutation.distance <= 1.0, "{refutation:?}");
        // NaN and +∞ claim nothing.
        assert_eq!(auditor.cell(&bound_of(f64::NAN, Lemma::Heights), 8), None);
        assert_eq!(auditor.cell(&bound_of(f64::INFINITY, Lemma::Heights), 8), None);
    });
}

/// A refuted lemma is struck, and the search without it has a valid interval; the lemmas of others stay.
#[test]
fn a_search_goes_on_without_a_refuted_lemma() {
    with_squares(|pair| {
        let mut search = BranchAndBound::new(pair, 1e-3, None, 0.0);
        // As if a cell had been pruned by a bound that lies.
        search.incumbent.prune(0.25);
        search.frontier = Frontier::new(SearchNode::root(0.25));
        search.audit.enter(bound_of(0.25, Lemma::Heights));
        search.audit.enter(bound_of(2.0, Lemma::Bilinear));
        // The node is pruned, then nothing is left to do, and what was relied on is audited.
        assert_eq!([search.advance(1000), search.advance(1000)], [None, None]);
        let report = search.audit_report();
        assert_eq!(report.struck.iter().collect::<Vec<_>>(), [Lemma::Heights]);
        assert_eq!((report.cells_of(Lemma::Heights), report.cells_of(Lemma::Bilinear)), (1, 1));
        assert_eq!(search.refutations().len(), 1);
        assert_eq!(run(&mut search), Stop::Converged);
        let Interval { lower, upper } = search.interval();
        assert!(lower <= 1.0 && (1.0..1.01).contains(&upper), "[{lower}, {upper}]");
    });
}

/// A search that ends at a budget is audited too: what is left of it is what the boxes say.
#[test]
fn an_ended_search_is_audited() {
    with_squares(|pair| {
        let mut search = BranchAndBound::new(pair, 1e-3, None, 0.0);
        search.frontier = Frontier::new(SearchNode::root(0.25));
        search.audit.enter(bound_of(0.25, Lemma::Heights));
        search.finish();
        let Interval { lower, upper } = search.interval();
        assert!(lower <= 1.0 && 1.0 <= upper, "[{lower}, {upper}]");
        assert!(search.audit_report().struck.contains(Lemma::Heights));
    });
}

/// Where all bounds are audited, so is each of an evaluation.
#[test]
fn an_evaluation_is_audited() {
    with_squares(|pair| {
        let mut search = BranchAndBound::new(pair, 1e-3, None, 0.0);
        let node =
            SearchNode { domain: Domain::Cell(bound_of(0.0, Lemma::Taylor).cell), ..SearchNode::root(2.0) };
        let of_tree = SearchNode::root(2.0);
        for node in [node, of_tree] {
            search.audit(Audit::All);
            let mut evaluation = search.evaluate(&node, 1.5);
            assert_eq!(evaluation.refutation, None);
            (evaluation.upper, evaluation.lemma) = (0.5, Some(Lemma::Taylor));
            assert_eq!(search.refutation_of(&node, &evaluation).unwrap().lemma, Lemma::Taylor);
            search.audit(Audit::Share);
            assert_eq!(search.refutation_of(&node, &evaluation), None);
        }
    });
}
