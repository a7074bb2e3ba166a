namespace FractalEngine.Core.Physics.Descriptions;

/// <summary>Counts what the joint solve of touching bodies has done since the world began or was reset.</summary>
/// <param name="Solves">Islands that were solved, each once a step.</param>
/// <param name="Rounds">Rounds of all these solves together.</param>
/// <param name="Unconverged">
/// Islands whose forces were not found to 1e-9 of the largest within the maximum number of rounds. Their step used what was found by
/// then, without more energy than before.
/// </param>
public readonly record struct IslandStatistics(long Solves, long Rounds, long Unconverged);
