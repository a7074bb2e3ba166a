using FractalEngine.Benchmarks.Approximation.Unseen;
using FractalEngine.Parsing;

namespace FractalEngine.Benchmarks.Approximation;

/// <summary>The models that the page on approximation shows, as files.</summary>
internal static class SampleModels
{
    private const int Repeats = 30;
    private const int TreeFaces = 30_000;
    private const int SmallFaces = 3_000;
    private const int OrganicFaces = 20_000;

    private static readonly (string Name, Func<UnseenInput> Create)[] All =
    [
        ("stairs", () => RepeatingModels.Create(RepeatKind.Stairs, 1, Repeats)),
        ("spiral-stairs", () => RepeatingModels.Create(RepeatKind.SpiralStairs, 1, Repeats)),
        ("wall", () => RepeatingModels.Create(RepeatKind.BrickWall, 1, Repeats)),
        ("temple", () => RepeatingModels.Create(RepeatKind.Temple, 1, Repeats)),
        ("gear", () => RepeatingModels.Create(RepeatKind.Gear, 1, Repeats)),
        ("broken-tree", () => Damaged(new(DamageKind.Missing, 0.5))),
        ("strange-tree", () => Damaged(new(DamageKind.MissingAndStrangers, 0.3, 0.3))),
        ("ruined-tree", () => Damaged(new(DamageKind.Missing, 0.8))),
        ("small-ruin", () => Damaged(new(DamageKind.Missing, 0.8), SmallFaces)),
        ("decimated-tree", () => Damaged(new(DamageKind.Decimated, 0.5))),
        ("creature", () => OrganicModels.Create(OrganicKind.Creature, 1, OrganicFaces)),
        ("terrain", () => OrganicModels.Create(OrganicKind.Terrain, 1, OrganicFaces)),
        ("bust", () => OrganicModels.Create(OrganicKind.Bust, 1, OrganicFaces)),
        ("rock", () => OrganicModels.Create(OrganicKind.Rock, 1, OrganicFaces)),
    ];

    /// <summary>Writes each model into a folder, as NAME.obj.</summary>
    public static void Write(string folder)
    {
        foreach (var (name, create) in All)
        {
            var mesh = create().Mesh;
            MeshFile.Write(Path.Combine(folder, $"{name}.obj"), mesh);
            Console.WriteLine(FormattableString.Invariant($"{name}.obj: {mesh.FaceCount} faces"));
        }
    }

    private static UnseenInput Damaged(Damage damage, int faces = TreeFaces) =>
        damage.Apply(UnseenFractals.Create(FractalKind.TreeWithIdentity, 1, faces), 1);
}
