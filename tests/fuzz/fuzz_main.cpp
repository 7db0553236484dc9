/* ----------------------------------------------------------------------
   lammps-hvi: hypervelocity impact for LAMMPS, GNU GPL version 2, see LICENSE
   libFuzzer on one of the checks of fuzz_readers.h, that which FUZZ_CHECK names: make fuzz
------------------------------------------------------------------------- */

#include "fuzz_readers.h"

#include <cstdio>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const unsigned char *data, size_t size)
{
  const std::string wrong = Fuzz::FUZZ_CHECK(std::string((const char *) data, size));
  if (wrong.empty()) return 0;
  fprintf(stderr, "%s\n", wrong.c_str());
  abort();
}
