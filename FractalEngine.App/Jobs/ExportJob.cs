using System.Collections.Immutable;
using FractalEngine.App.Shell;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Exports;
using FractalEngine.Parsing.Exports.Csv;
using FractalEngine.Parsing.Exports.Gltf;
using FractalEngine.Parsing.Exports.Ply;
using FractalEngine.Parsing.Exports.Stl;
using FractalEngine.Parsing.Exports.ThreeMf;
using FractalEngine.Parsing.Exports.Web;
using FractalEngine.Parsing.Wavefront.Writing;

namespace FractalEngine.App.Jobs;

/// <summary>Writes what a scene shows for other programs, in the format that the ending of the file's name says.</summary>
/// <param name="output">Path of the file; '-' is the standard output.</param>
/// <param name="hasMaterials">Whether a mesh of OBJ gets a file of materials.</param>
/// <param name="isWelded">Whether vertices that coincide are joined first.</param>
internal sealed class ExportJob(string output, bool hasMaterials, bool isWelded)
{
    // Beside OBJ, which has a file for its materials.
    private static readonly ImmutableArray<SceneExport> Formats =
    [
        new PlyExport(), new StlExport(), new ThreeMfExport(), new CsvExport(), new GltfExport(), new WebExport(),
    ];

    private readonly SceneExport? _format =
        Formats.FirstOrDefault(one => output.EndsWith(one.Ending, StringComparison.OrdinalIgnoreCase));

    /// <summary>The endings of all formats, with their dots.</summary>
    public static ImmutableArray<string> Endings { get; } = [".obj", .. Formats.Select(static format => format.Ending)];

    /// <inheritdoc cref="SceneExport.IsStaged"/>
    public bool IsStaged => _format?.IsStaged == true;

    /// <summary>Writes the file, or the mesh with its materials, whole or not at all.</summary>
    /// <param name="scene">What is shown.</param>
    /// <param name="settings">How much of it is written, and in which coordinates.</param>
    /// <param name="measure">Runs a part of the work, which it is told the name of.</param>
    /// <returns>What was written, and lines that warn.</returns>
    public ExportSummary Run(LoadedScene scene, ExportSettings settings, Action<string, Action> measure)
    {
        var remark = "";
        var losses = ImmutableArray<string>.Empty;
        if (isWelded)
        {
            losses = JoinedScene.LossesOf(scene);
            measure("weld", () => scene = JoinedScene.Of(scene, settings, isWelded: true));
            settings = settings with { MaxInstances = null };
            remark = $", {JoinedScene.Describe(scene)}";
        }

        var (materials, summary) = (hasMaterials && _format is null ? ExportedMaterials.For(scene, output) : null, new ExportSummary(""));
        measure("write", () =>
        {
            if (materials is null)
            {
                OutputFile.Write(output, Write, settings.Cancellation);
            }
            else
            {
                OutputFile.WritePair(materials.Path, materials.Write, output, Write, settings.Cancellation);
            }
        });
        return new(summary.Contents + remark + (materials is null ? "" : $", {materials.Describe()}"))
        {
            Losses =
            [
                .. losses.Concat(summary.Losses).Select(loss => $"{output}: warning: {loss}"), .. materials?.FindOutsideTextures() ?? [],
            ],
        };

        void Write(Stream stream) => summary = _format?.Write(scene, settings, stream)
            ?? ExportSummary.OfFaces(ObjSceneWriter.Write(scene, stream, settings, materials?.Materials, materials?.Name ?? "")) with
            {
                Losses = ExportedScene.LossesOf(scene, keepsTextures: true),
            };
    }
}
