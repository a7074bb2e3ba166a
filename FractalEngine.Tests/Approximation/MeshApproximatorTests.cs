using FractalEngine.Benchmarks.Approximation.Unseen;
using FractalEngine.Parsing.Approximation;

namespace FractalEngine.Tests.Approximation;

/// <summary>What large meshes are called, measured on the files as they are read back.</summary>
public sealed class MeshApproximatorTests
{
    /// <summary>Each face is compared with its image, however many there are; a bound for few faces called nothing exact.</summary>
    [Theory]
    [InlineData(1_000_000)]
    [Trait("Category", "Soak")]
    public void Find_OfManyFaces_IsExact(int faces)
    {
        var input = UnseenFractals.Create(FractalKind.Chain, 0, faces);
        var found = MeshApproximator.Find(input.Mesh);
        Assert.Equal(ApproximationVerdict.Exact, found.Verdict);
        Assert.InRange(found.Distance.MaxDistance.Upper, 0, 1e-6 * input.Mesh.UsedBounds.Diagonal);
    }
}
