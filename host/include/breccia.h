/* breccia as a library: everything a C program needs to read a scene, build its domain, run it on a device and look at
 * the state. An installed program includes <breccia.h> and links what `pkg-config --libs breccia` says.
 *
 *     brc_context *context = brc_context_create();
 *     brc_run_request request = {.path = "scene.yaml", .folder = "results", .device = "auto"};
 *     brc_run_results results;
 *     brc_status status = brc_run_scene(context, &request, &results);
 *     if (status != BRC_OK) fprintf(stderr, "%s\n", brc_context_message(context));
 *     brc_run_results_free(&results);
 *     brc_context_free(&context);
 *
 * or step by step: brc_scene_read, brc_scene_domain_build, brc_device_open, brc_simulation_create; or, also where bodies have models of their own,
 * brc_scene_read, brc_setup_domains, brc_setup_simulations, brc_lockstep_run. Nothing here ends the
 * program or keeps state outside the objects you create; a context belongs to one thread. C++ is not supported. */
#ifndef BRC_INCLUDE_BRECCIA_H
#define BRC_INCLUDE_BRECCIA_H

#include "../base/log.h"
#include "../base/memory.h"
#include "../base/status.h"
#include "../base/version.h"
#include "../../preprocess/build.h"
#include "../../preprocess/domain.h"
#include "../../preprocess/domain_file.h"
#include "../device/device.h"
#include "../scene/scene.h"
#include "../scene/scene_reader.h"
#include "../solver/lockstep.h"
#include "../solver/simulation.h"
#include "../output/export.h"
#include "../output/recorder.h"
#include "../commands/run_scene.h"
#include "../commands/scene_domain.h"
#include "../commands/setup.h"

#endif
