# What `./run test` leaves out, to end in eight minutes: for each room filters of GoogleTest. It is run
# by `./run deep rooms sanitized`, and by a ctest without `-LE long`.
set(long_spatial
  BroadPhase.AHundredThousandAtOnePointAreNoHangWhileTheySleep
  Follow.FindsThePairsOfAnUpdate3D
  KdTree.NoPlaneThatPartsNothing
  OrthtreeMemory.AHundredThousandAtOnePlaceNeitherHangNorSwell)
# Left out under sanitizers only: the release build does these, too.
set(long_physics
  WildWorlds/EachMethod.AreTameInSpace/direct
  WildWorlds/EachMethod.AreTameInSpace/impulse
  Carried.*
  Contacts.BodiesAtOnePointPart
  DepthBound.IsKeptWhateverIsWanted*
  Determinism.EveryBroadPhaseGivesTheSameBits
  Determinism.LookingAheadChangesNoBitAndNoCounter
  Determinism.RepeatsItself
  Determinism.SwitchingTheBroadPhaseMidRunChangesNothing
  DirectSolve.AHeapComesToRest
  DirectSolve.HoldsPyramidsInThePlane
  Extremes.AHundredBoxesStand
  Extremes.SizesFromAMillionthToAMillion
  Extremes.ThrownPilesGainNoEnergy
  Integrators.AnyDampingRatioIsFollowed
  Integrators.TheErrorFallsByTheOrderOfTheMethod
  PositionMethods.*
  Iteration.IsChosenWhereVeryManyAttractEachOther
  JointEnergy.TheDefaultIntegratorLosesNoEnergyToPins
  JointExtremes.PinsHoldUnderLoad
  Stability.*
  Stack.OfSixtyStands
  Stack.TenSweepsHoldTen
  WantedError.HighColumnsStandWhateverTheirNumbers*
  WantedError.MakesNoEnergyIn3D
  WantedError.WhatIsExactComesToRest
  WarmStep.AsksForNoMemory)
set(long_scenario
  Files/EveryPairChain.*/problems_chain_extreme
  Files/EveryPairChain.*/problems_pile_solid
  Files/EveryPairChain.*/problems_stack_extreme_thousand
  Files/EveryTally.*/problems_pile_solid
  Files/EveryTally.*/problems_pyramid_stiff)
# The golden frames are of every scenario, and CommandLine.CheckVerifiesEveryScenarioOfTheRepository
# checks each: what does so once more is here.
set(long_app
  LeaveOut.ExplainLoadsNoLibraryForAnyScenarioOrProblem
  OlderFolder.OfAnythingElse
  Readme.TheDemoDrawsEveryScenario
  StressCommand.CtrlCKeepsWhatIsFinished
  Warnings.AreGivenOfNothingThatComesWithLantern)
