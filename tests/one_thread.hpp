/// For tests whose figures hang on no number of threads: one each, since they run side by side.
#pragma once

#include <omp.h>

namespace toryu {

inline const bool one_thread = (omp_set_num_threads(1), true);

}  // namespace toryu
