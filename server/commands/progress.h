#pragma once

#include <string>

namespace volcast::commands {

/// One line on stderr that overwrites itself; nothing where stderr is no terminal.
class Progress {
public:
    Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    Progress(Progress&&) = delete;
    Progress& operator=(Progress&&) = delete;
    ~Progress() { clear(); }

    /// `fraction` in [0, 1].
    void show(const std::string& stage, double fraction);
    void clear();

private:
    bool terminal_;
    bool shown_ = false;
};

}  // namespace volcast::commands
