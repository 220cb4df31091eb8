"""Writes SCENE.md, the reference of every message of a scene, from the comments of scene.proto and what it imports.

    /usr/bin/python3 protocol/scene_reference.py          # after a change of them; a test compares
"""

import re
import subprocess
import tempfile
from pathlib import Path

from google.protobuf import descriptor_pb2

HERE = Path(__file__).resolve().parent
MESSAGES, ENUMS = 4, 5  # field numbers in FileDescriptorProto, of which source paths are made
FIELDS, VALUES = 2, 2  # in DescriptorProto and EnumDescriptorProto
HEAD = """# Scene reference

<!-- Made by protocol/scene_reference.py from the comments of scene.proto and what it imports: change those, and run it. -->

The message `Scene` and all it is made of, as a program sees them: names and numbers of the fields, types, units, defaults.
[clients/README.md](../clients/README.md#scenes) explains them with examples for who writes scenes by hand.

"""
Field = descriptor_pb2.FieldDescriptorProto


def load():
    """The descriptors of scene.proto and of the files that it imports, in the order of their names, with their comments."""
    with tempfile.TemporaryDirectory() as directory:
        out = Path(directory) / "scene.pb"
        words = ["protoc", f"-I{HERE}", "--include_source_info", "--include_imports", f"--descriptor_set_out={out}"]
        subprocess.run([*words, str(HERE / "scene.proto")], check=True)
        *imported, scene = descriptor_pb2.FileDescriptorSet.FromString(out.read_bytes()).file
        return [scene, *sorted(imported, key=lambda file: file.name)]


def comments_of(file):
    """The comment at each source path, on one line."""
    return {
        tuple(place.path): " ".join((place.leading_comments or place.trailing_comments).split())
        for place in file.source_code_info.location
    }


def split(comment):
    """Meaning, unit and default of a field's comment: `Density at zero pressure [kg/m^3]. Default 1000.`"""
    units = re.findall(r"\[([^\]]*)\]", comment)
    defaults = re.findall(r"Default:? (.*?)\.(?= |$)", comment)
    meaning = re.sub(r" ?Default:? .*?\.(?= |$)", "", comment)
    meaning = re.sub(r" ?\[[^\]]*\]", "", meaning) if len(units) == 1 else meaning
    unit = units[0] if len(units) == 1 and units[0] != "-" else ""
    return meaning.strip(" ."), unit, "; ".join(defaults)


def type_text(field):
    kind = Field.Type.Name(field.type).removeprefix("TYPE_").lower()
    name = field.type_name.rpartition(".")[2]
    text = f"[{name}](#{name.lower()})" if name else kind
    return f"{text} ..." if field.label == Field.LABEL_REPEATED else text


def row(cells):
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |\n"


def message_text(message, path, comments):
    text = f"## {message.name}\n"
    about = comments.get(path, "")
    text += f"{about}\n\n" if about else "\n"
    if not message.field:
        return text + "It has no fields.\n\n"
    text += row(["field", "number", "type", "unit", "default", "meaning"]) + "|---|---|---|---|---|---|\n"
    for k, field in enumerate(message.field):
        meaning, unit, default = split(comments.get((*path, FIELDS, k), ""))
        is_choice = field.HasField("oneof_index") and not field.proto3_optional
        choice = f"one of `{message.oneof_decl[field.oneof_index].name}`" if is_choice else ""
        meaning = "; ".join(part for part in (choice, meaning) if part)
        text += row([f"`{field.name}`", str(field.number), type_text(field), unit, default, meaning])
    return text + "\n"


def enum_text(enum, path, comments):
    about = comments.get(path, "")
    text = f"## {enum.name}\n" + (f"{about}\n\n" if about else "\n")
    text += row(["value", "number", "meaning"]) + "|---|---|---|\n"
    for k, value in enumerate(enum.value):
        if value.number > 0:
            text += row([f"`{value.name}`", str(value.number), comments.get((*path, VALUES, k), "").rstrip(".")])
    return text + "\n"


def reference():
    """The text of SCENE.md."""
    text = HEAD
    files = [(file, comments_of(file)) for file in load()]
    for file, comments in files:
        for k, message in enumerate(file.message_type):
            text += message_text(message, (MESSAGES, k), comments)
    for file, comments in files:
        for k, enum in enumerate(file.enum_type):
            text += enum_text(enum, (ENUMS, k), comments)
    return text.rstrip("\n") + "\n"


if __name__ == "__main__":
    (HERE / "SCENE.md").write_text(reference(), encoding="utf-8")
