/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * What is concluded from the evidence.
 */

#include <pcl/registration/kss/result.h>

#include <gtest/gtest.h>

namespace {

using namespace pcl::kss;

/** A pose of which surfaces explain this share in every respect. */
Alternative
explained(double share)
{
  Alternative alternative;
  alternative.transformation.setIdentity();
  alternative.overlap = {share, share, 1.5 * share};
  alternative.evidence.source = {share, share, share, share, 10000 * share};
  alternative.evidence.target = alternative.evidence.source;
  alternative.evidence.residual = 1.5 - 0.5 * share;
  return alternative;
}

Alternatives
listed(std::initializer_list<double> shares)
{
  Alternatives alternatives;
  for (const double share : shares)
    alternatives.push_back(explained(share));
  return alternatives;
}

TEST(Confidence, RisesWithTheEvidence)
{
  double before = 0.0;
  for (double share = 0.0; share <= 1.0; share += 0.05) {
    const double confidence = confidenceOf(listed({share}));
    EXPECT_GT(confidence, before) << share;
    EXPECT_LT(confidence, 1.0);
    before = confidence;
  }
  EXPECT_EQ(0.0, confidenceOf({}));
  EXPECT_LT(confidenceOf(listed({0.05})), 0.1);
  EXPECT_GT(confidenceOf(listed({0.9})), 0.95);
}

TEST(Confidence, OfAnObjectInASceneIsTheObjects)
{
  // the scene explains the object, the object nothing of the scene
  Alternative found = explained(0.7);
  found.evidence.target = {0.02, 0.01, 0.001, 0.3, 400};
  found.overlap = {1.0, 0.02, 0.75};
  const double as_parts = confidenceOf({found});
  found.evidence.size = 0.2;
  const double in_scene = confidenceOf({found});
  EXPECT_GT(in_scene, as_parts + 0.1);
  EXPECT_GT(in_scene, 0.8);
  // whichever of the clouds it is
  std::swap(found.evidence.source, found.evidence.target);
  std::swap(found.overlap.source, found.overlap.target);
  found.evidence.size = 5.0;
  EXPECT_NEAR(in_scene, confidenceOf({found}), 1e-12);
  // an object too small for the scene's points to show says nothing of that kind
  found.evidence.reach = 0.5;
  EXPECT_NEAR(as_parts, confidenceOf({found}), 1e-12);
}

TEST(Confidence, FallsWhereAnotherPoseIsAsGood)
{
  EXPECT_LT(confidenceOf(listed({0.6, 0.59})), confidenceOf(listed({0.6, 0.05})));
}

TEST(Confidence, OfFewPointsIsNeverFull)
{
  Alternatives few = listed({1.0});
  few[0].evidence.target.points = 20;
  EXPECT_LT(confidenceOf(few), 0.96);
  EXPECT_GT(confidenceOf(listed({1.0})), 0.98);
}

TEST(Ambiguity, IsASecondPoseThatIsAboutAsGood)
{
  EXPECT_FALSE(isAmbiguous({}));
  EXPECT_FALSE(isAmbiguous(listed({0.9})));
  EXPECT_TRUE(isAmbiguous(listed({0.9, 0.89})));
  EXPECT_TRUE(isAmbiguous(listed({0.9, 0.88, 0.1})));
  EXPECT_FALSE(isAmbiguous(listed({0.9, 0.5})));
  EXPECT_FALSE(isAmbiguous(listed({0.9, 0.2, 0.2})));
  // where nothing fits, nothing is ambiguous
  EXPECT_FALSE(isAmbiguous(listed({0.02, 0.02})));
}

TEST(Misfit, IsSaidInPercent)
{
  Evidence evidence;
  evidence.target.explained = 0.426;
  EXPECT_NE(std::string::npos,
            misfitAt(evidence).find("0 % of the source and 43 % of the target"));
  evidence.source.explained = 1.0;
  evidence.target.explained = 0.42;
  EXPECT_NE(std::string::npos,
            misfitAt(evidence).find("100 % of the source and 42 % of the target"));
}

} // namespace
