// SPDX-License-Identifier: GPL-3.0-or-later
// Completion as the shells themselves do it, and what a misspelt command line is told. A shell that
// is not there is left out, but for bash.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "run_gnomon.h"

namespace gnomon::test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

/// What a shell prints for a script, line by line.
std::vector<std::string> run_shell(const std::string& shell, const std::string& script) {
  const std::string command = shell + " '" + script + "' 2>&1";
  std::vector<std::string> lines;
  FILE* pipe = ::popen(command.c_str(), "r");
  std::string text;
  std::array<char, 4096> part{};
  while (const std::size_t read = std::fread(part.data(), 1, part.size(), pipe)) {
    text.append(part.data(), read);
  }
  EXPECT_EQ(::pclose(pipe), 0) << text;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

bool has_program(const std::string& name) {
  return std::system(("command -v " + name + " >/dev/null 2>&1").c_str()) == 0;
}

class Completion : public testing::Test {
 protected:
  /// The file that holds a shell's script.
  std::string script(const std::string& shell) {
    const RunResult written = run_gnomon({"completion", shell});
    EXPECT_EQ(written.status, 0) << written.err;
    write_text(directory_.file(shell), written.out);
    return directory_.file(shell);
  }
  /// What bash offers for the last of these words.
  std::vector<std::string> bash_offers(const std::vector<std::string>& words) {
    std::string text = "source " + script("bash") + "\nCOMP_WORDS=(";
    for (const std::string& word : words) text += " \"" + word + "\"";
    text += ")\nCOMP_CWORD=" + std::to_string(words.size() - 1) +
            "\n_gnomon\n((${#COMPREPLY[@]} == 0)) || printf \"%s\\n\" \"${COMPREPLY[@]}\"\n";
    write_text(directory_.file("ask"), text);
    return run_shell("bash", directory_.file("ask"));
  }
  TestDirectory directory_;
};

TEST_F(Completion, BashKnowsCommandsOptionsAndValues) {
  EXPECT_THAT(bash_offers({"gnomon", "cert"}), ElementsAre("certify"));
  EXPECT_THAT(bash_offers({"gnomon", ""}), Contains("shadows"));
  EXPECT_THAT(bash_offers({"gnomon", ""}), Not(Contains("worker")));
  EXPECT_THAT(bash_offers({"gnomon", "shadows", "--exact-f"}), ElementsAre("--exact-fractions"));
  EXPECT_THAT(bash_offers({"gnomon", "year", "--exact-f"}), IsEmpty());
  EXPECT_THAT(bash_offers({"gnomon", "shadows", "--kernel", "pl"}), ElementsAre("plane"));
  EXPECT_THAT(bash_offers({"gnomon", "year", "--sun-model", ""}),
              ElementsAre("erfa", "energyplus"));
  EXPECT_THAT(bash_offers({"gnomon", "shadows", "--algorithm", "secto"}), ElementsAre("sectors"));
}

TEST_F(Completion, BashTakesAnEqualsSignForAWord) {
  EXPECT_THAT(bash_offers({"gnomon", "shadows", "--kernel", "=", "ra"}), ElementsAre("rational"));
  EXPECT_THAT(bash_offers({"gnomon", "year", "--sun-at", "="}),
              ElementsAre("start", "middle", "end"));
}

TEST_F(Completion, BashOffersFilesWhereFilesAreTaken) {
  write_text(directory_.file("a room.json"), "{}");
  const std::string start = directory_.file("a r");
  EXPECT_THAT(bash_offers({"gnomon", "info", start}), ElementsAre(directory_.file("a room.json")));
  EXPECT_THAT(bash_offers({"gnomon", "shadows", "-o", start}),
              ElementsAre(directory_.file("a room.json")));
}

TEST_F(Completion, ZshAndFishReadTheirScripts) {
  if (has_program("zsh")) {
    EXPECT_THAT(run_shell("zsh -n", script("zsh")), IsEmpty());
  }
  if (!has_program("fish")) GTEST_SKIP() << "there is no fish";
  EXPECT_THAT(run_shell("fish -n", script("fish")), IsEmpty());
  const std::string ask = directory_.file("ask.fish");
  write_text(ask,
             "source " + script("fish") +
                 "\ncomplete -C \"gnomon shadows --kernel ra\"\ncomplete -C \"gnomon cert\"\n");
  EXPECT_THAT(run_shell("fish", ask), ElementsAre(StartsWith("rational"), StartsWith("certify\t")));
}

TEST_F(Completion, CommandsAreListedForManualPages) {
  const std::string commands = run_gnomon({"completion", "commands"}).out;
  EXPECT_THAT(commands, StartsWith("certify\nshadows\nyear\n"));
  EXPECT_EQ(run_gnomon({"completion", "tcsh"}).status, 2);
}

TEST(Misspelt, ACommandIsNamedAndTheNearestOneBesideIt) {
  const RunResult near = run_gnomon({"certfy", "room.json"});
  EXPECT_EQ(near.status, 2);
  EXPECT_EQ(near.err, "gnomon: no command 'certfy'; did you mean certify?\n");
  EXPECT_EQ(run_gnomon({"shadwos"}).err, "gnomon: no command 'shadwos'; did you mean shadows?\n");
  EXPECT_EQ(run_gnomon({"bake"}).err,
            "gnomon: no command 'bake'; expected one that 'gnomon --help' lists\n");
}

TEST(Misspelt, OptionsAreNamedInTheirOrder) {
  const RunResult wrong = run_gnomon({"info", "x.json", "--csv", "y"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.err, HasSubstr("not expected: --csv y; see 'gnomon info --help'"));
  EXPECT_THAT(run_gnomon({"shadows", "x.json", "--kernal=plane"}).err,
              HasSubstr("--kernal=plane; did you mean --kernel?"));
}

TEST(Misspelt, WithoutACommandThereIsHelp) {
  const RunResult bare = run_gnomon({});
  EXPECT_EQ(bare.status, 2);
  EXPECT_EQ(bare.out, "");
  const RunResult asked = run_gnomon({"help"});
  EXPECT_EQ(asked.status, 0);
  EXPECT_EQ(asked.out, bare.err);
  EXPECT_EQ(asked.out, run_gnomon({"--help"}).out);
  EXPECT_EQ(run_gnomon({"help", "year"}).out, run_gnomon({"year", "--help"}).out);
  EXPECT_EQ(run_gnomon({"help", "yeer"}).err, "gnomon: no command 'yeer'; did you mean year?\n");
}

}  // namespace
}  // namespace gnomon::test
