/* Which interface a bond lies in, and how its face stands to it. */
#ifndef BRC_SOLVER_INTERFACES_H
#define BRC_SOLVER_INTERFACES_H

#include "../../../../preprocess/domain/domain.h"
#include "../../../scene/scene.h"

/* The last interface of the scene that a bond between elements i and j lies in; -1: none. material: [n_elements] index
 * into scene->materials. */
int32_t brc_interface_of(const brc_scene *scene, const brc_domain *domain, const int32_t *material, int32_t i,
                         int32_t j);

/* Normals of interfaces: [n_bonds][3], out of the bond's smaller element, as long as the cosine c between the face, or
 * the beam, and the interface, or as `least` where that is more [-]; 0 of bonds in none; NULL: no bond lies in one; the
 * caller frees with brc_memory_free. An interface between uneven elements is rough, and a crack along it is as large as
 * its smooth plane. Its normal at a face is a mean of means: over the faces between the same two materials or grains at
 * the elements on one side that share one of the other side with this face, each weighed by its area. Steps of whole
 * cells cancel in it. Beside an edge of the interface, which such a mean rounds off, it is that of the flattest place
 * around, and the last mean leaves out normals that stand 30 degrees off. The face's own where they all look too
 * many ways for a plane. All ranks. BRC_NO_MEMORY. */
brc_status brc_interface_normals(brc_context *context, const brc_scene *scene, const brc_domain *domain,
                                 const int32_t *material, double least, double **out);

#endif
