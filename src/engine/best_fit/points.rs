//! Samples of a model for fits: those of fields.

use crate::alignment::Samples;
use crate::engine::PreparedModel;
use crate::facets::FacetSamples;
use crate::iteration::SamplingRule;

impl PreparedModel {
    /// Returns the samples of a field with the areas that they stand for. O(samples).
    pub(super) fn fit_samples(&self, samples: usize, rule: SamplingRule) -> Samples {
        self.fit_samples_where(samples, rule, |_| true)
    }

    /// Returns those of faces of surfaces; all of a mesh and of a cloud. O(samples).
    pub(super) fn fit_samples_where(
        &self,
        samples: usize,
        rule: SamplingRule,
        is_chosen: impl Fn(usize) -> bool,
    ) -> Samples {
        let (mut points, mut areas) = (Vec::new(), Vec::new());
        if let Some(facets) = self.facets() {
            for group in facets.targets() {
                let mut of_group = FacetSamples::of(group, samples);
                points.append(&mut of_group.points);
                areas.append(&mut of_group.areas);
            }
            return Samples::new(points, areas);
        }
        let prepared = self.sampling(samples, rule);
        let bezier = self.bezier();
        for (surface, (grid, patches)) in prepared.sampling.grids.iter().zip(&bezier.grids).enumerate() {
            if !is_chosen(self.face_of(surface)) {
                continue;
            }
            for (i, &(row, s)) in grid.locations[0].iter().enumerate() {
                for (j, &(column, t)) in grid.locations[1].iter().enumerate() {
                    let patch = bezier.patches.patch(patches.first + row * patches.counts()[1] + column);
                    let jet = patch.jet([s, t]);
                    let [u, v] = patch.domain.lengths();
                    let part = share(&grid.parameters[0], i) * share(&grid.parameters[1], j) / (u * v);
                    points.push(jet.point);
                    areas.push(jet.s.cross(jet.t).length() * part);
                }
            }
        }
        Samples::new(points, areas)
    }
}

/// The parameter range that a sample stands for: half of both its neighbours'.
fn share(parameters: &[f64], index: usize) -> f64 {
    let before = parameters[index.saturating_sub(1)];
    let after = parameters[(index + 1).min(parameters.len() - 1)];
    0.5 * (after - before)
}
