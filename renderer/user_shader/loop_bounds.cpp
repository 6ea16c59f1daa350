#include "renderer/user_shader/loop_bounds.h"

#include <cmath>

namespace volcast::user_shader {
namespace {

using glslang::TIntermAggregate;
using glslang::TIntermBinary;
using glslang::TIntermConstantUnion;
using glslang::TIntermLoop;
using glslang::TIntermSymbol;
using glslang::TIntermTyped;
using glslang::TIntermUnary;
using glslang::TOperator;

/// A number in the tree, of any type.
std::optional<double> constantOf(TIntermTyped* node) {
    TIntermConstantUnion* constant = node == nullptr ? nullptr : node->getAsConstantUnion();
    if (constant == nullptr || constant->getConstArray().size() != 1) return std::nullopt;
    const glslang::TConstUnion& value = constant->getConstArray()[0];
    switch (value.getType()) {
        case glslang::EbtFloat:
        case glslang::EbtDouble: return value.getDConst();
        case glslang::EbtInt: return value.getIConst();
        case glslang::EbtUint: return value.getUConst();
        default: return std::nullopt;
    }
}

/// The counter: `symbol = constant`, alone in the loop's first part.
struct Counter {
    TIntermSymbol* symbol = nullptr;
    double value = 0.0;
};

std::optional<Counter> counterOf(TIntermNode* start) {
    if (start == nullptr) return std::nullopt;
    if (TIntermAggregate* list = start->getAsAggregate()) {
        if (list->getSequence().size() != 1) return std::nullopt;
        return counterOf(list->getSequence().front());
    }
    TIntermBinary* assignment = start->getAsBinaryNode();
    if (assignment == nullptr || assignment->getOp() != glslang::EOpAssign) return std::nullopt;
    TIntermSymbol* symbol = assignment->getLeft()->getAsSymbolNode();
    const std::optional<double> value = constantOf(assignment->getRight());
    if (symbol == nullptr || !value) return std::nullopt;
    return Counter{.symbol = symbol, .value = *value};
}

bool isSymbol(TIntermTyped* node, const TIntermSymbol& symbol) {
    TIntermSymbol* other = node == nullptr ? nullptr : node->getAsSymbolNode();
    return other != nullptr && other->getId() == symbol.getId();
}

/// `counter < limit`, or another comparison.
struct Test {
    TOperator comparison = glslang::EOpNull;
    double limit = 0.0;

    [[nodiscard]] bool holds(double value) const {
        switch (comparison) {
            case glslang::EOpLessThan: return value < limit;
            case glslang::EOpLessThanEqual: return value <= limit;
            case glslang::EOpGreaterThan: return value > limit;
            case glslang::EOpGreaterThanEqual: return value >= limit;
            case glslang::EOpNotEqual: return value != limit;
            case glslang::EOpEqual: return value == limit;
            default: return false;
        }
    }
};

std::optional<Test> testOf(TIntermTyped* node, const TIntermSymbol& counter) {
    TIntermBinary* test = node == nullptr ? nullptr : node->getAsBinaryNode();
    if (test == nullptr || !isSymbol(test->getLeft(), counter)) return std::nullopt;
    const std::optional<double> limit = constantOf(test->getRight());
    const TOperator op = test->getOp();
    const bool compares = op == glslang::EOpLessThan || op == glslang::EOpLessThanEqual ||
                          op == glslang::EOpGreaterThan || op == glslang::EOpGreaterThanEqual ||
                          op == glslang::EOpNotEqual || op == glslang::EOpEqual;
    if (!limit || !compares) return std::nullopt;
    return Test{.comparison = op, .limit = *limit};
}

/// What is added to the counter each time: ++i, i--, i += constant, i -= constant.
std::optional<double> strideOf(TIntermTyped* node, const TIntermSymbol& counter) {
    if (node == nullptr) return std::nullopt;
    if (TIntermUnary* unary = node->getAsUnaryNode()) {
        if (!isSymbol(unary->getOperand(), counter)) return std::nullopt;
        switch (unary->getOp()) {
            case glslang::EOpPreIncrement:
            case glslang::EOpPostIncrement: return 1.0;
            case glslang::EOpPreDecrement:
            case glslang::EOpPostDecrement: return -1.0;
            default: return std::nullopt;
        }
    }
    TIntermBinary* binary = node->getAsBinaryNode();
    if (binary == nullptr || !isSymbol(binary->getLeft(), counter)) return std::nullopt;
    const std::optional<double> by = constantOf(binary->getRight());
    if (!by) return std::nullopt;
    if (binary->getOp() == glslang::EOpAddAssign) return *by;
    if (binary->getOp() == glslang::EOpSubAssign) return -*by;
    return std::nullopt;
}

/// Whether anything in a loop's body changes the counter.
class ChangesOf : public glslang::TIntermTraverser {
public:
    explicit ChangesOf(const TIntermSymbol& counter) : counter_{counter} {}
    [[nodiscard]] bool found() const { return found_; }

    bool visitBinary(glslang::TVisit, TIntermBinary* node) override { return look(node); }
    bool visitUnary(glslang::TVisit, TIntermUnary* node) override { return look(node); }
    bool visitAggregate(glslang::TVisit, TIntermAggregate* call) override {
        if (call->getOp() != glslang::EOpFunctionCall) return true;
        for (std::size_t i = 0; i < call->getSequence().size(); ++i) {
            const bool writes = i < call->getQualifierList().size() &&
                                (call->getQualifierList()[i] == glslang::EvqOut ||
                                 call->getQualifierList()[i] == glslang::EvqInOut);
            if (writes) compare(variableOf(call->getSequence()[i]));
        }
        return true;
    }

private:
    bool look(TIntermNode* node) {
        compare(changedBy(node));
        return true;
    }
    void compare(TIntermSymbol* symbol) {
        found_ = found_ || (symbol != nullptr && symbol->getId() == counter_.getId());
    }

    const TIntermSymbol& counter_;
    bool found_ = false;
};

}  // namespace

TIntermSymbol* variableOf(TIntermNode* node) {
    while (node != nullptr) {
        if (TIntermSymbol* symbol = node->getAsSymbolNode()) return symbol;
        TIntermBinary* part = node->getAsBinaryNode();
        node = part == nullptr ? nullptr : part->getLeft();
    }
    return nullptr;
}

TIntermSymbol* changedBy(TIntermNode* node) {
    if (TIntermBinary* binary = node->getAsBinaryNode()) {
        const bool assigns = binary->getOp() >= glslang::EOpAssign &&
                             binary->getOp() <= glslang::EOpRightShiftAssign;
        return assigns ? variableOf(binary->getLeft()) : nullptr;
    }
    TIntermUnary* unary = node->getAsUnaryNode();
    if (unary == nullptr) return nullptr;
    const bool counts =
        unary->getOp() == glslang::EOpPreIncrement || unary->getOp() == glslang::EOpPostIncrement ||
        unary->getOp() == glslang::EOpPreDecrement || unary->getOp() == glslang::EOpPostDecrement;
    return counts ? variableOf(unary->getOperand()) : nullptr;
}

LoopBound boundOf(TIntermLoop& loop, TIntermNode* start, int most) {
    constexpr const char* kForm =
        "; a loop is for (int i = CONSTANT; i < CONSTANT; ++i), or with another comparison and a "
        "constant step";
    const auto unbounded = [&](const char* why) {
        return LoopBound{.why = std::string{why} + kForm};
    };
    const std::optional<Counter> counter = counterOf(start);
    if (!counter) return unbounded("the loop's counter does not start at a constant");
    const std::optional<Test> test = testOf(loop.getTest(), *counter->symbol);
    if (!test) return unbounded("the loop's counter is not compared with a constant");
    const std::optional<double> stride = strideOf(loop.getTerminal(), *counter->symbol);
    if (!stride) return unbounded("the loop's counter does not change by a constant");
    ChangesOf changes{*counter->symbol};
    if (loop.getBody() != nullptr) loop.getBody()->traverse(&changes);
    if (changes.found()) return unbounded("the loop's counter is changed in its body");
    const bool real = counter->symbol->getBasicType() == glslang::EbtFloat;
    LoopBound bound;
    for (double value = counter->value; test->holds(value) && bound.iterations <= most;) {
        ++bound.iterations;
        value = real ? static_cast<double>(static_cast<float>(value) + static_cast<float>(*stride))
                     : value + *stride;
    }
    return bound;
}

}  // namespace volcast::user_shader
