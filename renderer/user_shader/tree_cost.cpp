#include "renderer/user_shader/tree_cost.h"

#include <algorithm>

#include "renderer/user_shader/check_text.h"
#include "renderer/user_shader/glslang_log.h"
#include "renderer/user_shader/loop_bounds.h"
#include "renderer/user_shader/parameters.h"

namespace volcast::user_shader {
namespace {

// An operator counts as one operation, a function of GLSL as four.
constexpr double kOperator = 1.0;
constexpr double kBuiltIn = 4.0;
// Functions without a body here read data: eight voxels and what finds them.
constexpr double kRead = 64.0;

/// How many numbers a variable of this type holds; in double, because products may be huge.
double componentsOf(const glslang::TType& type) {
    double count = 1.0;
    if (type.isStruct()) {
        count = 0.0;
        for (const glslang::TTypeLoc& member : *type.getStruct()) {
            count += componentsOf(*member.type);
        }
    } else {
        count = type.isMatrix() ? type.getMatrixCols() * type.getMatrixRows()
                                : std::max(type.getVectorSize(), 1);
    }
    if (!type.isArray()) return count;
    for (int i = 0; i < type.getArraySizes()->getNumDims(); ++i) {
        count *= std::max(type.getArraySizes()->getDimSize(i), 1);
    }
    return count;
}

/// "user_f(f1;" as "f".
std::string plainName(const std::string& mangled) {
    return withoutPrefix(mangled.substr(0, mangled.find('(')));
}

}  // namespace

TreeWalk::TreeWalk(const TreeInput& input, TIntermNode& root, std::vector<Complaint>& complaints)
    : input_{input}, root_{root}, complaints_{complaints} {
    if (root.getAsAggregate() == nullptr) return;
    for (TIntermNode* part : root.getAsAggregate()->getSequence()) {
        glslang::TIntermAggregate* function = part->getAsAggregate();
        if (function != nullptr && function->getOp() == glslang::EOpFunction) {
            functions_[function->getName().c_str()] = function;
        }
    }
}

bool TreeWalk::isUsers(const TIntermNode& node) const {
    return input_.userLine(node.getLoc().line) > 0;
}

void TreeWalk::complain(const TIntermNode& node, std::string message) {
    const int line = std::max(input_.userLine(node.getLoc().line), 1);
    const Complaint complaint{.line = line, .message = std::move(message)};
    if (std::ranges::find(complaints_, complaint) == complaints_.end()) {
        complaints_.push_back(complaint);
    }
}

Work TreeWalk::function(const std::string& name, const TIntermNode& caller) {
    if (const auto known = known_.find(name); known != known_.end()) return known->second;
    const auto found = functions_.find(name);
    if (found == functions_.end()) return {.cost = kRead};
    if (!open_.insert(name).second) {
        complain(caller, plainName(name) + "() calls itself");
        return {};
    }
    Work work;
    for (TIntermNode* part : found->second->getSequence()) work += node(part);
    open_.erase(name);
    known_[name] = work;
    return work;
}

void TreeWalk::everything() {
    for (const auto& [name, definition] : functions_) {
        if (isUsers(*definition)) function(name, *definition);
    }
    if (root_.getAsAggregate() == nullptr) return;
    for (TIntermNode* part : root_.getAsAggregate()->getSequence()) {
        glslang::TIntermAggregate* list = part->getAsAggregate();
        const bool other = list != nullptr && (list->getOp() == glslang::EOpFunction ||
                                               list->getOp() == glslang::EOpLinkerObjects);
        if (!other) node(part);
    }
}

Work TreeWalk::node(TIntermNode* node) {
    if (node == nullptr) return {};
    if (depth_ == kMaxTreeDepth) {
        complain(*node, "the expression or statement is nested more than " +
                            std::to_string(kMaxTreeDepth) + " deep");
        return {};
    }
    ++depth_;
    Work work;
    checkChange(*node);
    if (glslang::TIntermAggregate* list = node->getAsAggregate()) {
        work = aggregate(*list);
    } else if (glslang::TIntermBinary* binary = node->getAsBinaryNode()) {
        work = {.cost = kOperator};
        work += this->node(binary->getLeft());
        work += this->node(binary->getRight());
    } else if (glslang::TIntermUnary* unary = node->getAsUnaryNode()) {
        work = {.cost = kOperator};
        work += this->node(unary->getOperand());
    } else if (glslang::TIntermSelection* choice = node->getAsSelectionNode()) {
        work = {.cost = kOperator};
        work += this->node(choice->getCondition());
        work += this->node(choice->getTrueBlock());
        work += this->node(choice->getFalseBlock());
    } else if (glslang::TIntermSwitch* cases = node->getAsSwitchNode()) {
        work = this->node(cases->getCondition());
        work += this->node(cases->getBody());
    } else if (glslang::TIntermLoop* one = node->getAsLoopNode()) {
        work = loop(*one, nullptr);
    } else if (glslang::TIntermBranch* branch = node->getAsBranchNode()) {
        work = this->node(branch->getExpression());
    } else if (glslang::TIntermSymbol* variable = node->getAsSymbolNode()) {
        work = symbol(*variable);
    }
    --depth_;
    return work;
}

Work TreeWalk::aggregate(glslang::TIntermAggregate& list) {
    if (list.getOp() == glslang::EOpSequence || list.getOp() == glslang::EOpNull) {
        return sequence(list);
    }
    Work work;
    for (TIntermNode* part : list.getSequence()) work += node(part);
    if (list.getOp() == glslang::EOpFunctionCall) {
        work += function(list.getName().c_str(), list);
    } else if (list.getOp() != glslang::EOpParameters) {
        work.cost += kBuiltIn;
    }
    return work;
}

/// A for loop is a list whose last item is the loop and whose first, if any, starts its counter.
Work TreeWalk::sequence(glslang::TIntermAggregate& list) {
    Work work;
    TIntermNode* before = nullptr;
    for (TIntermNode* part : list.getSequence()) {
        glslang::TIntermLoop* last = part == nullptr ? nullptr : part->getAsLoopNode();
        work += last == nullptr ? node(part) : loop(*last, before);
        before = part;
    }
    return work;
}

Work TreeWalk::loop(glslang::TIntermLoop& loop, TIntermNode* start) {
    Work once = node(loop.getBody());
    once += node(loop.getTest());
    once += node(loop.getTerminal());
    if (!isUsers(loop)) return once;  // The renderer's own loops are short.
    const LoopBound bound = boundOf(loop, start, kMaxIterations);
    if (!bound.why.empty()) complain(loop, bound.why);
    if (bound.iterations > kMaxIterations) {
        complain(loop, "the loop runs more than " + std::to_string(kMaxIterations) + " times");
        return {};
    }
    const double times = bound.iterations;
    return {.cost = once.cost * times, .iterations = times + once.iterations * times};
}

Work TreeWalk::symbol(glslang::TIntermSymbol& symbol) {
    if (!isUsers(symbol)) return {};
    const double components = componentsOf(symbol.getType());
    if (components > kMaxArrayComponents) {
        complain(symbol, withoutPrefix(symbol.getName().c_str()) + " holds " + textOf(components) +
                             " numbers, at most " + textOf(kMaxArrayComponents));
    }
    return {};
}

void TreeWalk::checkChange(TIntermNode& node) {
    glslang::TIntermSymbol* symbol = changedBy(&node);
    if (symbol == nullptr || !isUsers(node)) return;
    const bool global = symbol->getQualifier().storage == glslang::EvqGlobal;
    const std::string name = withoutPrefix(symbol->getName().c_str());
    if (!global ||
        std::ranges::find(input_.controls, name, &Control::name) == input_.controls.end()) {
        return;
    }
    complain(node, name + " is a control; code cannot change it");
}

}  // namespace volcast::user_shader
