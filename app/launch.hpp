// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace tunica {

/// False in the second and further processes of one MPI job, which mpirun has started with one command: what
/// is not computed in common the first of them computes and tells. True where it is not sure: in tasks of a
/// batch system, which may each have a command of their own, and in what a process of a job starts by itself.
bool is_first_process();

}  // namespace tunica
