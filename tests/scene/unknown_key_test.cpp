// Keys that a scene file does not have: what is said of them.
#include "scene/file_fixture.hpp"

namespace piblocks {
namespace {

using UnknownKey = FileFixture;

TEST_F(UnknownKey, IsAnsweredByTheOneThatWasMeant) {
  const std::pair<const char*, const char*> cases[] = {
      {"[view]\nsiez = 1\n", "2: view.siez: unknown key; did you mean 'view.size'?"},
      {"[veiw]\nsize = 1\n", "2: veiw.size: unknown key; did you mean 'view.size'?"},
      {"[time]\nslow_motion = 1\n",
       "2: time.slow_motion: unknown key; did you mean 'time.slow-motion'?"},
      {"theme = 'dark'\n", "1: theme: unknown key; did you mean 'view.theme'?"},
      {"[show]\ntheme = 'dark'\n", "2: show.theme: unknown key; did you mean 'view.theme'?"},
      {"size = 1\n", "1: size: unknown key; did you mean 'view.size' or 'golden.size'?"},
      {"digts = 1\n", "1: digts: unknown key; did you mean 'digits'?"},
      {"[red]\nview.title = 1\n", "2: red.view.title: unknown key; did you mean 'show.title'?"},
      {"[view.colors]\nink = 1\n",
       "2: view.colors.ink = 1: must be a colour as \"#1f77b4\": # and six hexadecimal digits"},
      {"[view.colours]\nink = 1\n",
       "2: view.colours.ink: unknown key; did you mean 'view.colors.ink'?"},
      {"view.colors = 1\n", "1: view.colors: unknown key; a table is written [view.colors]"},
      {"quux.quuz = 1\n", "1: quux.quuz: unknown key"},
      {"[[part]]\nfad = 1\n", "2: fad: unknown key; did you mean 'fade'?"},
      {"fade = 1\n", "1: fade: unknown key; it belongs into a [[part]]"}};
  for (const auto& [text, said] : cases) expect_problem(text, said);
}

TEST_F(UnknownKey, MayBeATableThatIsWrittenOtherwise) {
  const std::pair<const char*, const char*> cases[] = {
      {"view = 3\n", "1: view: unknown key; a table is written [view]"},
      {"[[view]]\nsize = 3\n", "1: view: is one table, written [view]"},
      {"[body]\nposition = 1\n",
       "2: body.position: unknown key; write [[body]], once for each body"},
      {"[bodys]\nposition = 1\n",
       "2: bodys.position: unknown key; write [[body]], once for each body"},
      {"[parts]\nsplit = 'rows'\n",
       "2: parts.split: unknown key; write [[part]], once for each part"},
      {"[wall]\nnormal = [1, 0]\n",
       "2: wall.normal: unknown key; write [[wall]], once for each wall"},
      {"[[bodi]]\nposition = 1\n", "1: bodi: unknown list of tables; did you mean '[[body]]'?"},
      {"[[quux]]\nposition = 1\n",
       "1: quux: unknown list of tables; there are [[body]], [[wall]] and [[part]]"},
      {"[[part]]\ncomprae = [{digits = 1}, {digits = 2}]\n",
       "2: comprae: unknown list of tables; did you mean 'compare'?"}};
  for (const auto& [text, said] : cases) expect_problem(text, said);
}

TEST_F(UnknownKey, OfABodyIsAnsweredByItsKeys) {
  expect_problem("[[body]]\nposition = 1\nmas = 3\n",
                 "3: body 1.mas: unknown key; did you mean 'mass'?");
  expect_problem(
      "[[body]]\nposition = [1, 2]\nradius = 1\n[[wall]]\nnormal = [1, 0]\n"
      "point = [0, 0]\npiont = [0, 0]\n",
      "7: wall.piont: unknown key; did you mean 'point'?");
}

TEST_F(UnknownKey, MisspeltValuesAreAnsweredToo) {
  const std::pair<const char*, const char*> cases[] = {
      {"view.theme = 'Lectrue'\n", "did you mean 'lecture'?"},
      {"view.background = 'tranparent'\n", "did you mean 'transparent'?"},
      {"sound.on = 'ture'\n", "did you mean 'true'?"},
      {"show.overlays = ['time', 'mases']\n", "'mases' must be one of: digits, masses"},
      {"show.overlays = 'mases'\n", "did you mean 'masses'?"},
      {"show.panels = 'velcity'\n", "did you mean 'velocity'?"},
      {"show.overlays = 'certainty'\n",
       "'certainty' is a diagram; name it in show.panels (--panels)"},
      {"show.panels = 'masses'\n",
       "'masses' is drawn over the scene; name it in show.overlays (--show)"},
      {"time.to = 'lst'\n", "did you mean 'last'?"},
      {"[[part]]\nsplit = 'colums'\n", "did you mean 'columns'?"}};
  for (const auto& [text, said] : cases) {
    const std::vector<std::string> found = problems(text);
    ASSERT_EQ(found.size(), 1U) << text;
    EXPECT_TRUE(contains(found.front(), said));
  }
}

}  // namespace
}  // namespace piblocks
