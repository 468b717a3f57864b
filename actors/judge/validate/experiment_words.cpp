#include "actors/judge/validate/experiment_words.hpp"

namespace luxodus::light {

const char* const experiments_opening = R"md(# Experiments with people

`luxodus validate --experiments` holds the program's verdicts against experiments in which people
saw or read signs in smoke, in dim light and in clear air. This page is what the command writes.

```sh
build/release/luxodus validate --experiments             # all of them
build/release/luxodus validate --experiments --only T8   # one
build/release/luxodus validate --experiments --list      # their ids, titles and sources
```

Each experiment is a scene: a room, lamps, smoke and a target. The smoke is thickened, the distance
is lengthened or the contrast is lowered until the program's visibility level passes a limit. The
levels are those of `luxodus assess`: eye paths traced through the smoke, and the threshold of the
eye by Adrian (1989), with k = 2.6 for detection in 99.9 % of cases. A target is **seen** from level
1 on, its smallest detail is **read** from level 7 on. All steps towards one threshold use the same
random numbers.

No value of the program was chosen to suit an experiment. All eyes are 23 years old, since no
experiment covers the default of 65 years. Verdicts are of what can be read by a person who looks at
the sign and knows where it is.

Most thresholds are optical depths, extinction times distance (Jin's C). **C is a logarithm, so
agreement in C is cheap.** A difference of 0.7 is a factor of 2 in luminance, and a law with any
threshold contrast from 0.5 to 3 % comes close to C. Factors in luminance therefore stand beside the
thresholds.

## Rules of agreement

They were fixed before the experiments were run, from the scatter between people and between papers.
Some were written after an earlier version of the program had been tried on some of the cases. A
rule is kept or failing only if the value is two standard errors from its limit; otherwise it is not
answered.

- **S, seen.** The threshold at level 1 of the whole target is within 0.7 of the observed optical
  depth. The mean difference over all such thresholds is within 0.4.
- **R, read.** The threshold at level 7 of the detail is at most the observed one: nothing is
  promised that people did not read. The threshold at level 1 of the detail plus 0.5 is at least the
  observed one: nothing is denied that they read. Of an observed interval the lower end counts for
  the promise, the upper end for the denial.
- **U, unsafe.** In no trial is the verdict "legible" where the mean observer stops reading.
- **O, order.** The stated order holds. What is stated to be about equal differs by at most 0.7, and
  "much farther" is more than that.
- **A, acuity.** The level of a detail at the limit of acuity is 0.5 to 2.

Slopes, quotients and differences have limits of their own, which stand in the claims.

)md";

const char* const experiments_findings = R"md(## What the numbers say

**Light and grey targets (T1, T2, T5, T6).** Seeing agrees in value and in slope. The program sees
the disc of T1 farther by 0.2 in optical depth, a factor of 1.2 in luminance. The threshold contrast
of T2 is the measured one. Darker smoke is seen through farther, as in T6. The placards of T5 keep
the measured dependence on size, but the program wants 1.4 to 3.3 times the light that people
needed.

**Reading (T8, T12).** At 1 lx the program promises less than the one observer read: by a factor of
6 in luminance for two rings, and of 1.5 for the third, whose margin is thin. T12 fails at 1 and 2
m: the program still reads the small letters at the lower end of the densities in the abstract,
though not beyond their upper end. Which of these densities belongs to which sign, size and distance
is not in the abstract, so the lower end counts. At 1 m three times the size is read less far, not
farther: the ground of 86 cd/m2 then fills the view, lights the smoke before the letters, and the
eye adapts to it.

**The dark (T14 fails).** People saw pictograms as far at 1 to 2 lx as in the dark. The program
gives the dark 1.5 to 2.3 more in optical depth, the most for the darkest sign. The second table of
T14 says why: it is adaptation alone. In the dark the ground beside the sign has 0.007 to 0.03
cd/m2, which is light of the sign itself that the smoke scatters. At 1.5 lx it has 0.4 to 0.5 cd/m2.
The difference that Adrian's law asks for falls from 0.006 to about 0.001 cd/m2, and the logarithm
of that quotient is what was found. The law holds for eyes that are fully adapted to what they look
at, which takes half an hour in the dark. The rows "from the light" have eyes that were adapted to a
view of 100 cd/m2 until 10 s before, by a published law of bleached pigment (decision 91). That
takes 0.24 from the difference of the darkest sign, and less than 0.1 from the others: a room
bleaches some 6 % of the rods' pigment. So this part of adaptation does not explain what people saw.
People who look about in a room with a few lamps are adapted to more. "Visible" in the dark, and to
a lesser degree "legible", promise more than people have. No floor under the luminance of adaptation
was put in: its value would be fitted to this one abstract.

**Size in the dark (T16 fails).** A sign of 10 cm is lost where it was observed, at an optical depth
of 13. One of 20 cm is seen no farther: the difference is below 0.2 either way. The trials that are
not judged separate the terms:

- *Area (Ricco's law).* In smoke of albedo 0 the sign stands before darkness. There 20 cm are seen
  1.05 farther than 10 cm: twice the edge lowers the threshold by a factor of 2.9. Complete
  summation over the area would give a factor of 4.
- *Halo.* In white smoke the sign lights the smoke, and the eye adapts to the halo around it. That
  costs the small sign 2.4 and the large one 3.6, for four times the area scatter several times the
  light. The halo takes back all that the area has gained.
- *Narrower scattering* (g = 0.85 instead of 0.6) makes the halo denser: both signs are lost nearer,
  by about 1, and the gain is again nothing.

Nor could size help much: before the same ground an endless target would gain 2.4 over 10 cm. At an
optical depth of 13 the halo is as bright as the sign before it. At 22.5 what comes straight from a
sign of 250 cd/m2 is 4e-8 cd/m2, a twentieth of the threshold of an endless target before darkness.
No law of contrast makes that visible. Either people reported the glow of the smoke, or 22.5 is the
slope of a fitted line with an intercept, and not an optical depth at which the sign was seen. The
source was read third hand and does not say. So nothing was changed in the program. Its verdict
counts a silhouette, but no glow without an edge.

**Colour (T17).** Red is seen 1.33 times as far as blue in white smoke and 1.37 times in black
smoke, and white between them. That is the quotient of the wavelengths, 1.36, by an extinction that
is proportional to the inverse of the wavelength. In black smoke this is more than the 1.2 to 1.3 of
the source, which belong to exponents of 0.6 to 0.85. Nothing of this was seen by people: the source
computed it from extinctions as well.

**Clear air (T18, T20).** Levels at the limit of acuity are 0.7 to 1.1. EXIT is read no farther than
people identify it with confidence, but its stroke is called seen up to 150 m, where they identified
the word up to 90 m. Its polarity and luminances had to be assumed.

Errors are those of chance, from the scatter of levels with other random numbers. They are largest
in the dark, where few paths carry most of the light that is scattered beside the sign. The
luminances of the ground there are known to a factor of 2 only.

)md";

const char* const experiments_legend = R"md(
Thresholds carry their standard errors. "Above" and "below" an end of the searched interval mean
that no threshold lies in it. The luminance factor is exp(predicted - observed), of the threshold of
reading where people read and else of that of seeing. Above 1 the program grants people more than
they had; below 1 it asks for more light than they needed. The last column of the first table is the
program's verdict at the observed threshold, or at the lower end of an observed interval.

The second table says what limits the eye: the luminance of the ground around the target, which the
eye is adapted to, with the light that the smoke scatters; the difference that is just seen; and
what an endless target would gain before the same ground, in optical depth.

)md";

const char* const experiments_objections = R"md(## What a lighting or fire scientist would object to

- Sources were read second hand, and many values are readings of graphs. T8 has one observer, T1 to
  T6 do not say how many. No text of Jin's, of the FAA or of NIST was at hand in full.
- No experiment covers the default eye of 65 years. The law of age is not tested by any of this.
- Level 1 mixes criteria: Adrian's 99.9 % against "it just vanished". A factor of 2.6 either way is
  0.96 in optical depth, more than most differences here. Agreement may be luck, so slopes and
  quotients are tested besides values.
- Where the illuminance was measured is open. In white smoke this is 0.3 in optical depth, in black
  smoke up to 2.7. The unit of luminance of T6 is disputed by a factor of pi, 1.14 in optical depth.
- The share of scattering in the papers is a ratio to white smoke, not an albedo. Oil and filter
  paper are not soot. Forward scattering and halos are assumed (g = 0.6). Smoke was uniform; real
  layers are not.
- Most targets have the same angle, 31 arcmin. Only T5, T18 and T16 test size, and T16 disagrees.
- Adaptation: people came from the light, and T14 shows no gain in the dark. The program's eye is
  adapted to what it looks at. If "visible" is unsafe anywhere, it is in the dark, and emergency
  lighting is there.
- Known place, free eyes, no stress: in Jin's walk to an EXIT sign an unknown place cost a factor of
  5 in contrast.
- Colour: red and green at mesopic levels, and observers with protan vision. All comparisons here
  are white and photopic.

## What is not tested

- Eyes of 65 years, or of any age but a young adult's.
- Colours of signs, and of light, with people: T17 compares computed distances.
- Signs in an unknown place, noticed or not; people who walk, who are under stress, or who have just
  left a bright room.
- Irritation. The factor of Jin and Yamada (1985) is the program's own rule, so that a comparison
  with their data would only show that it was typed correctly.
- Layers and gradients of smoke; photoluminescent signs; oblique views; glare of lamps in sight.

## What was found and is not used

- Jin 1972 (III): ten men walk to a lit EXIT sign: seen at optical depths of 4.6 to 10; luminance
  and size of the sign are not in what was read.
- Jin and Yamada 1985: Landolt chart at 4 m, C = 6: luminance of the chart is not in what was read;
  the factor of irritation is the program's own rule.
- Collins, Dahir, Madrzykowski 1990, NISTIR 4399: the abstract has no values in smoke: luminance
  matters most, then uniformity.
- Tuomisaari 1997, VTT Publications 300; Fujii, Sano, Ohmiya 2014; Baek et al. 2022: abstracts
  without thresholds.
- Frantzich and Nilsson 2003; Fridolf et al. 2013: walking speeds in tunnels, no thresholds.
- Colomb et al. 2007: targets in a fog chamber against Adrian's model: the nearest precedent; only
  its abstract was read.
)md";

}  // namespace luxodus::light
