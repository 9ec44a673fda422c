# What Doxygen reads instead of a header: the prose at its top documents the file, and the words after a member (its
# unit, its range) document the member. Run with sed -E; lines stay where they are, so that warnings name the right one.
1s|.*|/// @file|
2,/^#pragma once/s|^//( ?)|///\1|
s|([;,]) +// |\1 ///< |
s|^( {20,})// |\1///< |
