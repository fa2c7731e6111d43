// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

// Programs that link the installed package include this before anything else (compile option
// -include of pcl_als::common): PCL's headers then bring the bodies of their templates, in whatever
// order headers are included. A definition on the command line would be a second one for programs
// that have their own, as PCL's documentation asks of users of their own point types.
#ifndef PCL_NO_PRECOMPILE
#define PCL_NO_PRECOMPILE
#endif
