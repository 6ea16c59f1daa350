#pragma once

#include <optional>
#include <string>

#include <glslang/Include/intermediate.h>

namespace volcast::user_shader {

/// How often a loop runs, or why nobody can say.
struct LoopBound {
    int iterations = 0;  ///< At most `most` + 1.
    std::string why;     ///< Not empty: there is no bound.
};

/// Of `loop`, a for loop whose first part is `start` (null: it has none); counts up to `most` + 1.
LoopBound boundOf(glslang::TIntermLoop& loop, TIntermNode* start, int most);

/// The variable that an expression such as a.x[i] is a part of; null where there is none.
glslang::TIntermSymbol* variableOf(TIntermNode* node);

/// What `node` itself changes, its parts aside; null where nothing.
glslang::TIntermSymbol* changedBy(TIntermNode* node);

}  // namespace volcast::user_shader
