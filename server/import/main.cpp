// volcast-import: reads one dataset in a sandbox and hands it to who started it.

#include "server/import/import_job.h"

int main(int argc, char** argv) {
    return volcast::import::importMain(argc, argv, nullptr);
}
