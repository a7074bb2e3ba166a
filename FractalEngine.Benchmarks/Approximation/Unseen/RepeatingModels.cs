namespace FractalEngine.Benchmarks.Approximation.Unseen;

/// <summary>Makes models that repeat without shrinking, as people model them: units share the vertices at which they meet.</summary>
/// <remarks>
/// Each is one connected mesh, without faces inside, but the links of a chain, which do not touch. Elements are its units. Units at the
/// ends may have more or fewer faces than the others where a solid is closed there, so that not all are images of a base.
/// </remarks>
internal static class RepeatingModels
{
    /// <summary>The least number of units of a model.</summary>
    public const int MinRepeats = 30;

    /// <summary>Makes the model of a kind and a seed, shuffled but without other damage.</summary>
    /// <param name="kind">What repeats.</param>
    /// <param name="seed">Chooses all proportions; any integer.</param>
    /// <param name="repeats">How many units there are at least, from 30; walls and grids round them up.</param>
    public static UnseenInput Create(RepeatKind kind, int seed, int repeats)
    {
        ArgumentOutOfRangeException.ThrowIfLessThan(repeats, MinRepeats);
        var random = new SeededRandom(kind.ToString(), seed);
        var frame = ModelFrame.Draw(random);
        var input = kind switch
        {
            RepeatKind.Stairs => Weld(PatchModels.Stairs(random, repeats, isSpiral: false)),
            RepeatKind.SpiralStairs => Weld(PatchModels.Stairs(random, repeats, isSpiral: true)),
            RepeatKind.BrickWall => CellModels.BrickWall(random, frame, seed, repeats),
            RepeatKind.Temple => Weld(PatchModels.Temple(random, repeats)),
            RepeatKind.Grating => CellModels.Grating(random, frame, seed, repeats),
            RepeatKind.Bolt => Weld(PatchModels.Bolt(random, repeats)),
            RepeatKind.Gear => Weld(PatchModels.Gear(random, repeats)),
            RepeatKind.Fence => CellModels.Fence(random, frame, seed, repeats),
            RepeatKind.Links => Weld(PatchModels.Links(random, repeats)),
            RepeatKind.Truss => Weld(PatchModels.Truss(random, repeats)),
            _ => throw new ArgumentOutOfRangeException(nameof(kind), kind, "no kind of model"),
        };
        return Damage.None.Apply(input, seed);

        UnseenInput Weld(RepeatedPatches patches) => patches.Weld(frame, kind.ToString(), seed);
    }
}
