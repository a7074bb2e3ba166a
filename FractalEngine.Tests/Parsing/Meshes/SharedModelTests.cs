using FractalEngine.Parsing;
using FractalEngine.Parsing.Meshes;
using FractalEngine.Parsing.Text;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Parsing.Meshes;

/// <summary>Tests files by other programs; an independent script counted their vertices and triangles.</summary>
public class SharedModelTests
{
    // Valid except for normals that the faces refer to and the files lack.
    private static readonly string[] WithoutNormals =
        ["tinyobjloader/smoothing-group-two-squares.obj", "tinyobjloader/catmark_torus_creases0.obj"];

    // Invalid on purpose, with missing elements or numbers: a proper message is accepted as well as a mesh.
    private static readonly string[] InvalidFileWords = ["invalid", "nan", "zero", "failure", "leading-spaces"];

    [SkippableFact]
    public void Parse_OfEveryRealFile_GivesItsVerticesAndTriangles()
    {
        Skip.If(SharedModels.Folder is null, "there is no folder of real models beside the checkout");
        Assert.All(SharedModels.ReadTable().Where(row => !WithoutNormals.Contains(row.File)), row =>
        {
            try
            {
                var mesh = Parse(row.File).Mesh;
                Assert.Equal((row.File, row.Vertices, row.Triangles), (row.File, mesh.VertexCount, mesh.FaceCount));
            }
            catch (SourceException error) when (InvalidFileWords.Any(word => row.File.Contains(word, StringComparison.Ordinal)))
            {
                Assert.Matches(@"^[^\n]*:[1-9]\d*:[1-9]\d*: error: \S", error.Message);
            }
        });
    }

    [SkippableFact]
    public void Parse_OfTheLargestFile_TakesNoQuadraticTime()
    {
        Skip.If(SharedModels.Folder is null, "there is no folder of real models beside the checkout");
        // It takes a tenth of a second.
        Assert.Equal(70_000, ProcessorTime.RunWithin(5, () => Parse("meshes/nefertiti-lowres.obj").Mesh.FaceCount));
    }

    private static ParsedObj Parse(string file) =>
        ObjParser.Parse(SourceText.Read(Path.Combine(SharedModels.Folder!, file), file, ParsingLimits.MaxObjBytes, acceptLatin1: true));

    [SkippableFact]
    public void Parse_OfRealFilesWithoutTheNormalsTheyName_GivesTheirTriangles()
    {
        Skip.If(SharedModels.Folder is null, "there is no folder of real models beside the checkout");
        // Every other program shows these files.
        Assert.All(SharedModels.ReadTable().Where(row => WithoutNormals.Contains(row.File)),
            row => Assert.Equal(row.Triangles, Parse(row.File).Mesh.FaceCount));
    }
}
