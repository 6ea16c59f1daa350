#pragma once

#include <map>
#include <set>
#include <string>

#include <glslang/Include/intermediate.h>

#include "renderer/user_shader/tree_check.h"

namespace volcast::user_shader {

/// Operations and rounds of loops.
struct Work {
    double cost = 0.0;
    double iterations = 0.0;
    Work& operator+=(const Work& more) {
        cost += more.cost;
        iterations += more.iterations;
        return *this;
    }
};

/// Walks the tree of a shader from a function on, into the functions that it calls.
class TreeWalk {
public:
    TreeWalk(const TreeInput& input, TIntermNode& root, std::vector<Complaint>& complaints);

    /// Of one call of the function with this mangled name, such as "usermain(".
    Work function(const std::string& name, const TIntermNode& caller);
    /// Of all functions and initialisers of the user's, called or not.
    void everything();

private:
    Work node(TIntermNode* node);
    Work aggregate(glslang::TIntermAggregate& list);
    Work sequence(glslang::TIntermAggregate& list);
    Work loop(glslang::TIntermLoop& loop, TIntermNode* start);
    Work symbol(glslang::TIntermSymbol& symbol);
    void checkChange(TIntermNode& node);
    void complain(const TIntermNode& node, std::string message);
    [[nodiscard]] bool isUsers(const TIntermNode& node) const;

    const TreeInput& input_;
    TIntermNode& root_;
    std::vector<Complaint>& complaints_;
    std::map<std::string, glslang::TIntermAggregate*> functions_;
    std::map<std::string, Work> known_;
    std::set<std::string> open_;  ///< On the way from main() to here.
    int depth_ = 0;
};

}  // namespace volcast::user_shader
