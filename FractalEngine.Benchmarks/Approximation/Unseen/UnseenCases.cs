namespace FractalEngine.Benchmarks.Approximation.Unseen;

/// <summary>Enumerates the inputs by which a search is judged, each made when it is asked for.</summary>
/// <remarks>Meshes that are no models are those of <see cref="BadInputs"/>, one for each <see cref="BadInputKind"/>.</remarks>
internal static class UnseenCases
{
    /// <summary>Lists fractals of all kinds and some seeds, with some damages.</summary>
    public static IEnumerable<UnseenCase> Fractals(IEnumerable<int> seeds, int targetFaces, IEnumerable<Damage> damages) =>
        Combine<FractalKind>(seeds, damages, (kind, seed) => UnseenFractals.Create(kind, seed, targetFaces));

    /// <summary>Lists models that repeat, of all kinds and some seeds, with some damages.</summary>
    public static IEnumerable<UnseenCase> Repeating(IEnumerable<int> seeds, int repeats, IEnumerable<Damage> damages) =>
        Combine<RepeatKind>(seeds, damages, (kind, seed) => RepeatingModels.Create(kind, seed, repeats));

    /// <summary>Lists irregular shapes of all kinds and some seeds, without damage.</summary>
    public static IEnumerable<UnseenCase> Organic(IEnumerable<int> seeds, int faces) =>
        Combine<OrganicKind>(seeds, [Damage.None], (kind, seed) => OrganicModels.Create(kind, seed, faces));

    private static IEnumerable<UnseenCase> Combine<TKind>(
        IEnumerable<int> seeds, IEnumerable<Damage> damages, Func<TKind, int, UnseenInput> create)
        where TKind : struct, Enum =>
        from kind in Enum.GetValues<TKind>()
        from seed in seeds
        from damage in damages
        select new UnseenCase(
            FormattableString.Invariant($"{kind} {seed} {damage.Name}"), damage, seed, () => create(kind, seed));
}
