# SPDX-License-Identifier: MIT
"""What the program answers to words of other programs, to misspelt ones, and to a file without a sub-command."""
import re

from program import SCENES, ProgramTest, main

# What people type to F3D, Blender, Mitsuba and pbrt, and what it is called here.
ANSWERS = {
    "--spp": "-n --samples-per-pixel --sample_count --pixelsamples",
    "--size": "--width --height -W -H -w -r --resolution --res --resolution=640x480",
    "--env": "--envmap --hdri --environment --HDRI",
    "--max-bounces": "--max-depth --max_depth --maxdepth --bounces",
    "--background": "--bg --bg-color --background-color",
    "--eye": "--camera-position --origin",
    "--target": "--look-at --lookat",
    "--camera": "--camera-index",
    "--vfov": "--fov --camera-view-angle",
    "--backend": "--gpu --cpu",
    "--verbose": "-v --debug",
    "--quiet": "-q --silent",
    "--threads": "-t -j --nthreads",
    "--time": "--frame -f --animation-time",
    "--output": "--out --ouput --outfile",
    "--tone-map": "--tonemap --tone-mapping",
    "--camera ": "--cameras --cam",
    "metamarch devices": "--list-devices",
    "ending": "-F --file-format",
    "--aov": "--passes --aovs",
    "--bits": "--bit-depth",
    "--half": "--fp16 --half-float",
    "sRGB": "--gamma",
    "--exposure": "--gain --ev",
    "--transparent": "--film-transparent --no-background --alpha",
    "--shadow-catcher": "--shadow-plane --ground-plane",
    "--denoise": "--denoiser",
    "--crop": "--border --crop-window",
    "no file of settings": "--config",
    "standard error": "--log",
}


class WordsTest(ProgramTest):
    def test_words_of_other_programs(self):
        for answer, words in ANSWERS.items():
            for word in words.split()[:1]:  # a run of the program takes 0.2 s; the others are beside it in one table
                with self.subTest(word=word):
                    line = self.refuse(2, "render", "Box.glb", word, "4")
                    self.assertRegex(line, rf"\Arender: unknown argument `{re.escape(word)}`; .*{re.escape(answer.strip())}\b")

    def test_short_words_are_guessed_only_where_most_letters_fit(self):
        """`--fps` has one letter of `--up` and of `--spp`; a third of three letters may be wrong."""
        for word, answer in {"--fps": "", "--jsn": "", "--spq": "; did you mean `--spp`?", "--eey": "", "--ey": "",
                             "--sise": "; did you mean `--size`?", "--outptu": "; did you mean `--output`?"}.items():
            with self.subTest(word=word):
                self.assertEqual(self.refuse(2, "render", "Box.glb", word, "4"),
                                 f"render: unknown argument `{word}`{answer} (see `metamarch render --help`)")

    def test_an_unknown_option_is_named_before_a_missing_one(self):
        self.assertRegex(self.refuse(2, "render", "Box.glb", "--outptu", "x.png"),
                         r"render: unknown argument `--outptu`; did you mean `--output`\?")
        self.assertRegex(self.refuse(2, "render", "-box.glb", "-o", "y.png"), r"render: unknown argument `-box.glb`")
        self.assertRegex(self.refuse(2, "render", "Box.glb"), r"render: --output is required")
        self.assertRegex(self.refuse(2, "bench", "traversal", "--sise", "3x3"), r"bench: unknown argument `--sise`; did you mean `--size`\?")

    def test_a_file_without_a_sub_command(self):
        self.assertRegex(self.refuse(2, "Box.glb", "-o", "x.png"),
                         r"no sub-command given; did you mean `metamarch render Box.glb -o x.png`\?")
        self.assertRegex(self.refuse(2, "-o", "x.png", "Box.glb"), r"did you mean `metamarch render -o x.png Box.glb`\?")

    def test_words_in_place_of_a_sub_command(self):
        for words, answer in {"help": "--help", "version": "--version", "-v": "--version", "-V": "--version", "rendr": "render",
                              "--list-devices": "metamarch devices"}.items():
            self.assertRegex(self.refuse(2, words), rf"unknown (sub-command|option) `{words}`; .*`?{answer}`")

    def test_answers_are_sentences(self):
        for word in ("-v", "-V"):
            self.assertEqual(self.refuse(2, word),
                             f"unknown option `{word}`; `metamarch --version` prints the version (see `metamarch --help`)")

    def test_help_fits_a_page(self):
        listing = self.succeed("--help").split("Subcommands:")[1].split("Exit codes:")[0]
        commands = [[], ["bench", "traversal"], ["bench", "paper"], *([name] for name in re.findall(r"^  (\w+) ", listing, re.MULTILINE))]
        for command in commands:
            for line in self.succeed(*command, "--help").splitlines():
                self.assertLessEqual(len(line), 100, (command, line))

    def test_info_lists_names(self):
        text = self.succeed("info", SCENES / "cornell.glb")
        self.assertRegex(text, r"(?m)^cameras +0 'front': perspective, vertical field of view [\d.]+ degrees$")
        self.assertRegex(text, r"(?m)^materials +0 '.+': \d+ triangles$")


if __name__ == "__main__":
    main()
