//! Two surfaces at the same distance: the smaller id wins, whatever the order in which the tree was built.

use crate::embree;

/// What the tie-breaking filter remembers of the best hit so far.
#[repr(C)]
pub(crate) struct TieContext {
    rtc: embree::RtcRayQueryContext,
    distance: f32,
    object: u32,
    primitive: u32,
}

impl TieContext {
    #[inline(always)]
    pub fn new() -> Self {
        Self {
            rtc: embree::RtcRayQueryContext { inst_id: embree::INVALID, inst_prim_id: embree::INVALID },
            distance: f32::INFINITY,
            object: u32::MAX,
            primitive: u32::MAX,
        }
    }
}

/// Called by Embree for each candidate that is no farther than the best: an equal distance is won by the smaller id.
pub(crate) unsafe extern "C" fn break_ties(arguments: *const embree::RtcFilterArguments) {
    // SAFETY: single-ray queries pass one ray, one hit and the context given to the query.
    unsafe {
        let arguments = &*arguments;
        let best = &mut *arguments.context.cast::<TieContext>();
        let (ray, hit) = (&*arguments.ray, &*arguments.hit);
        let object = if hit.inst_id == embree::INVALID { hit.geom_id } else { hit.inst_id };
        if ray.tfar == best.distance && (object, hit.prim_id) >= (best.object, best.primitive) {
            *arguments.valid = 0;
            return;
        }
        best.distance = ray.tfar;
        best.object = object;
        best.primitive = hit.prim_id;
    }
}
