"""Colors for LAMMPS input: the command, comments, variables, quoted text."""

from pygments.lexer import RegexLexer
from pygments.token import Comment, Keyword, Name, String, Text


class LAMMPSLexer(RegexLexer):
    name = "LAMMPS"
    aliases = ["LAMMPS", "lammps"]
    tokens = {
        "root": [
            (r"\s+", Text),
            (r"#.*", Comment),
            (r"[a-z_]+", Keyword, "arguments"),
            (r".", Text, "arguments"),
        ],
        "arguments": [
            (r"&[ \t]*\n", Text),
            (r"\n", Text, "#pop"),
            (r"#.*", Comment),
            (r"\$\{[^}]*\}|\$\([^)]*\)", Name.Variable),
            (r'"[^"\n]*"', String),
            (r"[^\s&#$\"]+|[ \t]+|.", Text),
        ],
    }


def setup(app):
    app.add_lexer("LAMMPS", LAMMPSLexer)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
