using System.Collections.Immutable;
using FractalEngine.Core.Geometry;
using FractalEngine.Parsing.Meshes;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Assets;

/// <summary>
/// Loads the materials of meshes and looks for their pictures. Each file is read once, however many meshes name it. Nothing is an error: what
/// can't be had gives a warning, and the mesh is drawn without it.
/// </summary>
/// <param name="references">Says which files may be named.</param>
/// <param name="warnings">Receives what is wrong.</param>
internal sealed class MaterialLoader(FileReferences references, List<Diagnostic> warnings)
{
    // Beyond so many missing pictures, one more message tells nobody anything.
    private const int MostPictureFaults = 20;

    private readonly Dictionary<string, MtlFile?> _files = [];
    private readonly Dictionary<(MtlFile File, string Name), Material> _materials = [];

    // The pictures that were looked at, and whether they are fit.
    private readonly Dictionary<string, bool> _pictures = [];
    private readonly HashSet<(string Referrer, string File)> _missing = [];
    private long _pixels;
    private int _pictureFaults;

    /// <summary>The size of all files looked at, each once.</summary>
    public long StorageBytes { get; private set; }

    /// <summary>The materials that a mesh's groups name, as far as there are any.</summary>
    /// <param name="mesh">Parsed.</param>
    /// <param name="source">Its text.</param>
    /// <param name="full">The full path of its file.</param>
    public ImmutableDictionary<string, Material> Load(ObjFile mesh, SourceText source, string full)
    {
        var names = mesh.Mesh.Groups.Select(group => group.Material).Where(name => name.Length > 0).Distinct().ToArray();
        if (names.Length == 0 || mesh.Mesh.MaterialLibraries.IsEmpty)
        {
            return ImmutableDictionary<string, Material>.Empty;
        }

        var libraries = LoadLibraries(mesh, source, full, out var isComplete);
        var materials = ImmutableDictionary.CreateBuilder<string, Material>();
        foreach (var name in names)
        {
            if (libraries.FirstOrDefault(library => library.File.Materials.ContainsKey(name)) is { File: not null } library)
            {
                materials.Add(name, Resolve(library.File, library.Full, name));
            }
        }

        var unknown = names.Where(name => !materials.ContainsKey(name)).ToArray();
        // Where a file is missing that has been said, and its materials are no further news.
        if (unknown.Length > 0 && isComplete)
        {
            var all = unknown.Length == 1 ? "" : $" ({unknown.Length} such materials in all)";
            Warn(source.Diagnose(mesh.MaterialOffsets[unknown[0]], $"no material file declares \"{unknown[0]}\": drawn in the object's own colour{all}"));
        }

        return materials.ToImmutable();
    }

    private List<(MtlFile File, string Full)> LoadLibraries(ObjFile mesh, SourceText source, string full, out bool isComplete)
    {
        var libraries = new List<(MtlFile File, string Full)>();
        Diagnostic? firstFault = null;
        var faults = 0;
        foreach (var (names, offset) in mesh.Mesh.MaterialLibraries.Zip(mesh.MaterialLibraryOffsets))
        {
            foreach (var name in references.IsThere(full, names) ? [names] : MaterialFileNames.In(names))
            {
                // A message costs a look through the whole text: one is enough.
                if (firstFault is not null && !references.IsThere(full, name))
                {
                    faults++;
                    continue;
                }

                try
                {
                    var (path, shown) = references.Resolve(source, offset, full, name);
                    if (Read(path, shown) is { } file)
                    {
                        libraries.Add((file, path));
                    }
                    else
                    {
                        faults++;
                    }
                }
                catch (SourceException fault)
                {
                    firstFault ??= fault.Diagnostic;
                    faults++;
                }
            }
        }

        if (firstFault is not null)
        {
            Warn(firstFault with { Message = faults == 1 ? firstFault.Message : $"{firstFault.Message} ({faults} such files in all)" });
        }

        isComplete = faults == 0;
        return libraries;
    }

    /// <summary>Null where the file is no text or too long; that is said once.</summary>
    private MtlFile? Read(string full, string name)
    {
        if (_files.TryGetValue(full, out var known))
        {
            return known;
        }

        try
        {
            var file = MtlParser.Parse(SourceText.Read(full, name, ParsingLimits.MaterialBytes, acceptLatin1: true));
            StorageBytes += new FileInfo(full) is { Exists: true } info ? info.Length : 0;
            warnings.AddRange(file.Warnings);
            return _files[full] = file;
        }
        catch (SourceException fault)
        {
            Warn(fault.Diagnostic);
            return _files[full] = null;
        }
    }

    /// <summary>A material with the full path of its picture, or without one that can't be had.</summary>
    private Material Resolve(MtlFile file, string full, string name)
    {
        if (_materials.TryGetValue((file, name), out var known))
        {
            return known;
        }

        var material = file.Materials[name];
        if (material.Texture is { } texture)
        {
            material = FindPicture(file.Source, file.TextureOffsets[name], full, texture.Path) is { } path
                ? material with { Texture = texture with { Path = path } }
                : material.WithoutPicture();
        }

        return _materials[(file, name)] = material;
    }

    private string? FindPicture(SourceText source, int offset, string referrer, string file)
    {
        if (_pictureFaults >= MostPictureFaults && !references.IsThere(referrer, file))
        {
            return null;
        }

        try
        {
            var (full, _) = references.Resolve(source, offset, referrer, file);
            if (!_pictures.TryGetValue(full, out var isFit))
            {
                _pictures[full] = false;
                Check(source, offset, full, file);
                isFit = _pictures[full] = true;
            }

            return isFit ? full : null;
        }
        catch (SourceException fault)
        {
            // Said once of each file, however many materials name it.
            if (_missing.Add((source.FileName, file)) && ++_pictureFaults <= MostPictureFaults)
            {
                var end = _pictureFaults < MostPictureFaults ? "" : "; further pictures that can't be had are not named";
                Warn(fault.Diagnostic with { Message = $"{fault.Diagnostic.Message}: drawn grey{end}" });
            }

            return null;
        }
    }

    private void Check(SourceText source, int offset, string full, string file)
    {
        try
        {
            // Pipes and devices say that they are empty, and opening one may wait for ever.
            if (new FileInfo(full).Length == 0)
            {
                throw source.Error(offset, $"\"{file}\" is empty, expected a picture");
            }

            using var stream = new FileStream(full, FileMode.Open, FileAccess.Read, FileShare.Read);
            if (stream.Length > ParsingLimits.PictureBytes)
            {
                throw source.Error(offset, $"the picture \"{file}\" is larger than the limit of {ParsingLimits.PictureBytes} bytes", isLimit: true);
            }

            var isTga = Path.GetExtension(full).Equals(".tga", StringComparison.OrdinalIgnoreCase);
            if (PictureSize.Read(stream, isTga) is not ( > 0 and var width, > 0 and var height))
            {
                throw source.Error(offset, $"\"{file}\" is no PNG, JPEG, BMP or TGA picture");
            }

            if (Math.Max(width, height) > ParsingLimits.PictureSide)
            {
                throw source.Error(
                    offset, $"the picture \"{file}\" has {width}×{height} pixels, more than the limit of {ParsingLimits.PictureSide} a side", isLimit: true);
            }

            if (_pixels + (width * height) > ParsingLimits.PicturePixels)
            {
                throw source.Error(
                    offset, $"with \"{file}\" all pictures have more than the limit of {ParsingLimits.PicturePixels} pixels", isLimit: true);
            }

            _pixels += width * height;
            StorageBytes += stream.Length;
        }
        catch (Exception exception) when (exception is IOException or UnauthorizedAccessException)
        {
            throw source.Error(offset, $"the picture \"{file}\" can't be read: {exception.Message}");
        }
    }

    private void Warn(Diagnostic diagnostic) => warnings.Add(diagnostic with { Severity = DiagnosticSeverity.Warning });
}
