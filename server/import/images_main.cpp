// volcast-import-images: the same with OpenImageIO, for pictures alone.

#include "renderer/data/load/image_stack.h"
#include "server/import/import_job.h"

int main(int argc, char** argv) {
    return volcast::import::importMain(argc, argv, &volcast::data::load::readImages);
}
