/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_TEXT_H
#define LMP_HVI_TEXT_H

#include <cstdlib>
#include <string>
#include <vector>

namespace HVI {

/* ----------------------------------------------------------------------
   Text of material files and of tables: lines, words, numbers, and the
   comments at their heads.
------------------------------------------------------------------------- */

inline std::vector<std::string> split(const std::string &text)
{
  static const char *blank = " \t\r\f\v";
  std::vector<std::string> words;
  size_t from = text.find_first_not_of(blank);
  while (from != std::string::npos) {
    const size_t to = text.find_first_of(blank, from);
    words.push_back(text.substr(from, to - from));
    from = text.find_first_not_of(blank, to);
  }
  return words;
}

// decimal numbers only: no hexadecimal ones, no inf or nan by name

inline bool number(const std::string &word, double &x)
{
  if (word.find_first_not_of("0123456789+-.eE") != std::string::npos) return false;
  char *end = nullptr;
  x = std::strtod(word.c_str(), &end);
  return end != word.c_str() && *end == '\0';
}

// UNITS: and DATE: in the comments at the head of a file

struct Header {
  std::string units, date;

  // from the words of one comment; says what is wrong

  std::string read(const std::vector<std::string> &words, const std::string &run_units);
};

// one line after the other

class Lines {
 public:
  Lines(const std::string &text, const std::string &filename) : text(text), filename(filename)
  {
    if (text.compare(0, 3, "\xef\xbb\xbf") == 0) from = 3;    // a byte order mark, as of Windows
  }

  std::string comment;               // what stands behind #
  std::vector<std::string> words;    // what stands before it
  int line = 0;

  bool next()
  {
    if (from >= text.size()) return false;
    size_t to = text.find('\n', from);
    if (to == std::string::npos) to = text.size();
    const std::string whole = text.substr(from, to - from);
    from = to + 1;
    line++;
    const size_t hash = whole.find('#');
    comment = hash == std::string::npos ? "" : whole.substr(hash + 1);
    words = split(whole.substr(0, hash));
    return true;
  }

  std::string at(int where, const std::string &what) const
  {
    return filename + ":" + std::to_string(where) + ": " + what;
  }
  std::string here(const std::string &what) const { return at(line, what); }

 private:
  const std::string &text;
  const std::string &filename;
  size_t from = 0;
};

}    // namespace HVI

#endif
