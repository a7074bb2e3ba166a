namespace FractalEngine.Core.Fractals.Levels;

/// <summary>The part of a repetition that one edge stands for, where a level of the hierarchy is many levels of the fractal.</summary>
/// <param name="MapIndex">Index of the map in the set of the repetition.</param>
/// <param name="IdentityIndex">Index of the identity in the set; −1 for none.</param>
/// <param name="Exponent">How often the edge applies the map.</param>
/// <param name="Count">Number of levels of the whole repetition.</param>
/// <param name="LevelBelow">Remaining levels below the repetition.</param>
internal sealed record MapPower(int MapIndex, int IdentityIndex, long Exponent, long Count, long LevelBelow);
