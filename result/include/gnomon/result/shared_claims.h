// SPDX-License-Identifier: LGPL-3.0-or-later
// What a result tells of several lights at once (Claims::combined and Claims::overlay), as claims
// of one light after another, so that they are judged like all others: a fragment of "combined" is
// lit if the light is in `lit_by`, else penumbra if it is in `penumbra_of`, else shadow or umbra; a
// loop of "overlay" is shadow if the light is in `dark_for`, else lit, and the highest level tells.
//
// Exactness: loops are copied as they are; nothing is computed.
#ifndef GNOMON_RESULT_SHARED_CLAIMS_H
#define GNOMON_RESULT_SHARED_CLAIMS_H

#include "gnomon/result/claims.h"
#include "gnomon/scene/scene.h"

namespace gnomon {

/// The blocks of shared fragments that the claims have, each as claims of its own. Its lights are
/// those of `claims.lights`, or all of the scene if these are none; of an overlay the point and
/// directional ones. Its problems name unknown lights and polygons, lights that stand where their
/// kind cannot, sides listed twice, and painted loops that contradict their owner.
std::vector<Claims> shared_claims(const Claims& claims, const Scene& scene);

}  // namespace gnomon

#endif  // GNOMON_RESULT_SHARED_CLAIMS_H
