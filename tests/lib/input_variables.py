"""Variables of the inputs of examples."""

import re


def known(script):
    """names that an input takes with -var"""
    text = script.read_text()
    return set(re.findall(r"\bvariable +(\w+) +index\b", text)) | set(re.findall(r"is_defined\(variable,(\w+)\)", text))
