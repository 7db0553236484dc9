/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_VARIABLE_LIST_H
#define LMP_HVI_VARIABLE_LIST_H

#include "info.h"

#include <algorithm>
#include <string>
#include <vector>

namespace HVI {

/* ----------------------------------------------------------------------
   All variables of an input.  LAMMPS shows styles to class Info alone, which
   says them in text:
   Variable[  0]: dx,                style = index,            def = 0.4
   Variable[  1]: a,                 style = equal,            def = 1e-3*v_dx 0.0004
   where the last word is the value that was asked for last.  Where none was, LAMMPS (both versions)
   shows what happens to be in memory: what is no text is cut off first.  Sanitizers see that.
------------------------------------------------------------------------- */

struct VariableText {
  std::string name, style, value;    // value: of a list, all, with blanks between them
};

inline std::vector<VariableText> variable_list(LAMMPS_NS::LAMMPS *lmp)
{
  LAMMPS_NS::Info info(lmp);
  int n = 0;
  const auto names = info.get_variable_names(n);
  std::vector<VariableText> list;
  for (int i = 0; i < n; i++) {
    static const std::string STYLE = "style = ", VALUE = "def = ";
    std::string text = info.get_variable_info(i);
    if (!text.empty() && text.back() == '\n') text.pop_back();
    const size_t style = text.find(STYLE), value = text.find(VALUE, style);
    if (style == std::string::npos || value == std::string::npos) continue;
    const size_t from = style + STYLE.size();
    VariableText one = {std::string(names[i]), text.substr(from, text.find(',', from) - from),
                        text.substr(value + VALUE.size())};
    if (one.style == "equal") {
      const auto no_text = [](unsigned char c) {
        return c != '\t' && (c < ' ' || c > '~');
      };
      one.value.erase(std::find_if(one.value.begin(), one.value.end(), no_text), one.value.end());
      one.value.resize(one.value.rfind(' '));
    }
    list.push_back(one);
  }
  return list;
}

}    // namespace HVI

#endif
