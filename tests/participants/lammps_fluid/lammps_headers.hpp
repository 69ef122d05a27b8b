/// The headers of LAMMPS that are needed here. Before them: those of its tools are left out, as they are
/// written for an older fmt than Debian's, and nothing of theirs is used.
#pragma once

#define LMP_UTILS_H

#include <atom.h>
#include <comm.h>
#include <fix.h>
#include <force.h>
#include <input.h>
#include <lammps.h>
#include <library.h>
#include <memory.h>
#include <modify.h>
#include <neigh_list.h>
#include <neighbor.h>
#include <pair.h>
#include <pointers.h>
