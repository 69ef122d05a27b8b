/// Signals as a wish that a program fulfils at its next step.
#pragma once

namespace toryu {

/// From now on SIGINT, SIGTERM, SIGHUP and SIGUSR1, which mpirun passes on to its processes, only ask to
/// stop; one that is ignored, as SIGHUP under nohup, stays so.
void catch_interruptions();
/// True once one of them came.
bool interruption_requested();
/// Throws Interrupted if so; call it once a step.
void throw_if_interrupted();
/// The same once a second one came: for what can end in good order when asked for the first time.
void throw_if_interrupted_again();

}  // namespace toryu
