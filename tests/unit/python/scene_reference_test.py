"""protocol/SCENE.md is what the comments of scene.proto and what it imports say."""

import os
import sys
import unittest
from pathlib import Path

PROTOCOL = Path(os.environ["SLUICE_SOURCE"]) / "protocol"
sys.path.insert(0, str(PROTOCOL))
import scene_reference  # noqa: E402


class SceneReferenceTest(unittest.TestCase):
    def test_is_up_to_date(self):
        written = (PROTOCOL / "SCENE.md").read_text(encoding="utf-8")
        self.assertEqual(written, scene_reference.reference(), "run /usr/bin/python3 protocol/scene_reference.py")

    def test_comments_are_taken_apart(self):
        for comment, parts in {
            "Density at zero pressure rho0 [kg/m^3]. Default 1000.": ("Density at zero pressure rho0", "kg/m^3", "1000"),
            "Coulomb coefficient [-]. Default 0.3.": ("Coulomb coefficient", "", "0.3"),
            "[m]": ("", "m", ""),
            "Stiffness and damping; [N/m], [N s/m].": ("Stiffness and damping; [N/m], [N s/m]", "", ""),
        }.items():
            self.assertEqual(scene_reference.split(comment), parts)

    def test_every_field_has_a_row(self):
        text = scene_reference.reference()
        for message in (message for file in scene_reference.load() for message in file.message_type):
            section = text.partition(f"\n## {message.name}\n")[2].partition("\n## ")[0]
            for field in message.field:
                self.assertIn(f"\n| `{field.name}` | {field.number} |", section)
