//! The sampling frustum of the hybrid's view-dependent pass (Wallace, Cohen and Greenberg 1987; book 4.5.2).

use glam::Vec3;
use illuminant_optics::frame::Frame;

/// Rays along the edges of a square frustum about the mirror direction, with the weights of a Gaussian of which a half-width is `gloss`
/// (Wallace et al. 1987; book 4.5.2): they add up to 1.
pub(crate) fn frustum_about(to_viewer: Vec3, gloss: f32, edge: u32) -> Vec<(Vec3, f32)> {
    let mirrored = Vec3::new(-to_viewer.x, -to_viewer.y, to_viewer.z);
    let frame = Frame::from_normal(mirrored);
    // Out to where the Gaussian is a hundredth.
    let reach = (gloss * (100f32.ln() / 2f32.ln()).sqrt()).min(1.2).tan();
    let place = |i: u32| reach * ((i as f32 + 0.5) * 2.0 / edge as f32 - 1.0);
    let mut rays: Vec<(Vec3, f32)> = (0..edge * edge)
        .map(|k| {
            let (x, y) = (place(k % edge), place(k / edge));
            let direction = frame.to_world(Vec3::new(x, y, 1.0).normalize());
            let angle = x.hypot(y).atan();
            // An equal part of the square is seen under cos³.
            let part = (-(angle / gloss.max(1e-4)).powi(2) * 2f32.ln()).exp() * angle.cos().powi(3);
            // What would go into the surface is lost to the rest.
            (direction, if direction.z * to_viewer.z > 0.0 { part } else { 0.0 })
        })
        .collect();
    let sum: f32 = rays.iter().map(|(_, part)| part).sum();
    rays.retain(|(_, part)| *part > 0.0);
    rays.iter_mut().for_each(|(_, part)| *part /= sum);
    rays
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_add_up_and_lean_towards_the_mirror_direction() {
        let view = Vec3::new(0.6, 0.0, 0.8);
        for edge in [2, 5, 8] {
            let rays = frustum_about(view, 0.2, edge);
            let sum: f32 = rays.iter().map(|(_, part)| part).sum();
            let mean: Vec3 = rays.iter().map(|(direction, part)| *direction * *part).sum();
            assert!((sum - 1.0).abs() < 1e-5);
            assert!(mean.normalize().dot(Vec3::new(-0.6, 0.0, 0.8)) > 0.9999);
        }
        // Near grazing none of them goes into the surface.
        let grazing = Vec3::new(0.995, 0.0, 0.1).normalize();
        assert!(frustum_about(grazing, 0.3, 6).iter().all(|(direction, _)| direction.z > 0.0));
    }
}
