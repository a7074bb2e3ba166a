using System.Collections.Immutable;
using FractalEngine.Core;
using FractalEngine.Core.Files;
using FractalEngine.Core.Geometry;
using FractalEngine.Parsing.Assets.References;
using FractalEngine.Parsing.Fdo;
using FractalEngine.Parsing.Meshes;
using FractalEngine.Parsing.Mtl;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Assets;

/// <summary>
/// Loads the materials of meshes and finds their textures. Each file is read once, however many meshes refer to it.
/// </summary>
/// <remarks>Material problems cause warnings only: the mesh is drawn without what is missing.</remarks>
/// <param name="references">Resolves the names of files.</param>
/// <param name="warnings">Receives the warnings.</param>
/// <param name="record">Gives the stamps of the files.</param>
/// <param name="cache">Holds files that were read before; null for none.</param>
internal sealed class MaterialLoader(
    FileReferenceResolver references, List<Diagnostic> warnings, FileRecord record, AssetCache? cache)
{
    private readonly Dictionary<string, ParsedMtl?> _materialFiles = [];
    private readonly Dictionary<(ParsedMtl File, string Name), ResolvedMaterial> _materials = [];
    private readonly TextureFiles _textures = new(references, warnings);
    private long _fileBytes;

    /// <summary>Total size of the files read so far, each counted once, in bytes.</summary>
    public long StorageBytes => _fileBytes + _textures.StorageBytes;

    /// <summary>Loads the materials that the groups of a mesh name; missing ones are not in the result.</summary>
    /// <param name="mesh">Parsed mesh with names of material files.</param>
    /// <param name="fullPath">Full path of the mesh's file.</param>
    public ImmutableDictionary<string, Material> Load(ParsedObj mesh, string fullPath)
    {
        var names = mesh.Mesh.Groups.Select(group => group.Material).Where(name => name.Length > 0).Distinct().ToArray();
        if (names.Length == 0)
        {
            return ImmutableDictionary<string, Material>.Empty;
        }

        var libraries = LoadLibraries(mesh, fullPath, out var isComplete);
        if (mesh.Mesh.MaterialLibraries.IsEmpty && !TryAddOwnLibrary(libraries, mesh.MaterialPositions[names[0]], fullPath))
        {
            return ImmutableDictionary<string, Material>.Empty;
        }

        var materials = ImmutableDictionary.CreateBuilder<string, Material>();
        foreach (var name in names)
        {
            if (libraries.FirstOrDefault(library => library.File.Materials.ContainsKey(name)) is { File: not null } library)
            {
                materials.Add(name, ResolveMaterial(library.File, library.FullPath, name));
            }
        }

        var unknownMaterials = names.Where(name => !materials.ContainsKey(name)).ToArray();
        // A missing file has its own warning; that its materials are missing too adds nothing.
        if (unknownMaterials.Length > 0 && isComplete)
        {
            var totalNote = unknownMaterials.Length == 1 ? "" : $" ({unknownMaterials.Length} such materials in all)";
            Warn(mesh.MaterialPositions[unknownMaterials[0]].Diagnose(
                $"no material file declares \"{unknownMaterials[0]}\": drawn in the object's own colour{totalNote}"));
        }

        return materials.ToImmutable();
    }

    /// <summary>Loads the material that a fractal file gives to a base mesh.</summary>
    /// <param name="source">Text of the fractal file.</param>
    /// <param name="reference">Names of the material and its file.</param>
    /// <param name="fullPath">Full path of the fractal file.</param>
    /// <exception cref="SourceException">The file can't be read, or does not declare the material.</exception>
    public (string Name, Material Material, string FilePath) LoadNamed(SourceText source, MaterialReference reference, string fullPath)
    {
        var (path, displayName) = references.Resolve(source, reference.Offset, fullPath, reference.File);
        if (!_materialFiles.TryGetValue(path, out var file) || file is null)
        {
            file = ReadOrFind(path, displayName);
        }

        var names = file.Materials.Keys;
        var name = reference.Name ?? (names.Count() == 1 ? names.First() : throw source.Error(
            reference.Offset, FormattableString.Invariant($"the file declares {names.Count()} materials: name one of them behind it")));
        return file.Materials.ContainsKey(name) ? (name, ResolveMaterial(file, path, name), path) : throw source.Error(
            reference.Offset, $"the file declares no material '{name}'{NameSuggestion.Ask(name, names)}");
    }

    /// <summary>Leaves out the images within a mesh's own file that can't be used, each with a warning.</summary>
    /// <param name="materials">Materials with the bytes of their images.</param>
    /// <param name="fileName">Name of the mesh's file in messages.</param>
    public ImmutableDictionary<string, Material> WithUsableImages(IReadOnlyDictionary<string, Material> materials, string fileName) =>
        materials.ToImmutableDictionary(static pair => pair.Key, pair => TextureSlot.All.Aggregate(
            pair.Value, (material, slot) => slot.Of(material) is { } texture && !_textures.IsUsable(texture, fileName, slot.Consequence)
                ? slot.With(material, null) : material));

    /// <summary>
    /// Adds the material file beside a mesh that has the mesh's name, for meshes that name none. False without such a file.
    /// </summary>
    private bool TryAddOwnLibrary(List<(ParsedMtl File, string FullPath)> libraries, SourcePosition use, string fullPath)
    {
        var name = Path.ChangeExtension(FileKinds.RemoveCompression(Path.GetFileName(fullPath)), ".mtl");
        if (references.FindForeign(fullPath, name) is null)
        {
            return false;
        }

        var (path, displayName) = references.ResolveForeign(use.Source, use.Offset, fullPath, name);
        if (ReadMaterialFile(path, displayName) is { } file)
        {
            libraries.Add((file, path));
        }

        return libraries.Count > 0;
    }

    private List<(ParsedMtl File, string FullPath)> LoadLibraries(ParsedObj mesh, string fullPath, out bool isComplete)
    {
        var libraries = new List<(ParsedMtl File, string FullPath)>();
        Diagnostic? firstFault = null;
        var faultCount = 0;
        foreach (var (names, position) in mesh.Mesh.MaterialLibraries.Zip(mesh.MaterialLibraryPositions))
        {
            foreach (var name in references.Exists(fullPath, names) ? [names] : MaterialFileNames.Split(names))
            {
                // A message costs a search through the whole text: one is enough.
                if (firstFault is not null && references.FindForeign(fullPath, name) is null)
                {
                    faultCount++;
                    continue;
                }

                try
                {
                    var (path, displayName) = references.ResolveForeign(position.Source, position.Offset, fullPath, name);
                    if (ReadMaterialFile(path, displayName) is { } file)
                    {
                        libraries.Add((file, path));
                    }
                    else
                    {
                        faultCount++;
                    }
                }
                catch (SourceException fault)
                {
                    firstFault ??= fault.Diagnostic;
                    faultCount++;
                }
            }
        }

        if (firstFault is not null)
        {
            var totalNote = faultCount == 1 ? "" : $" ({faultCount} such files in all)";
            Warn(firstFault with { Message = firstFault.Message + totalNote });
        }

        isComplete = faultCount == 0;
        return libraries;
    }

    /// <summary>Reads a material file once. Returns null, with one warning, if it is not text or too large.</summary>
    private ParsedMtl? ReadMaterialFile(string fullPath, string displayName)
    {
        if (_materialFiles.TryGetValue(fullPath, out var cached))
        {
            return cached;
        }

        try
        {
            return ReadOrFind(fullPath, displayName);
        }
        catch (SourceException fault)
        {
            Warn(fault.Diagnostic);
            return _materialFiles[fullPath] = null;
        }
    }

    private ParsedMtl ReadOrFind(string fullPath, string displayName)
    {
        var file = AssetCache.ReadOrFind(cache, fullPath, record.Add(fullPath), () =>
        {
            var read = MtlParser.Parse(SourceText.Read(fullPath, displayName, ParsingLimits.MaterialBytes.Value, acceptLatin1: true));
            cache?.ReadCount += 1;
            return read;
        });
        _fileBytes += file.Source.ByteCount;
        warnings.AddRange(file.Warnings);
        return _materialFiles[fullPath] = file;
    }

    /// <summary>Returns a material with the full path of its texture, or without a texture that can't be used.</summary>
    private Material ResolveMaterial(ParsedMtl file, string fullPath, string name)
    {
        if (_materials.TryGetValue((file, name), out var cached))
        {
            record.AddRange(cached.Files);
            return cached.Material;
        }

        var filesBefore = record.Position;
        var material = file.Materials[name];
        foreach (var slot in TextureSlot.All)
        {
            if (slot.Of(material) is { } texture)
            {
                var offset = file.TextureNameOffsets[texture];
                material = slot.With(material, _textures.Find(file.Source, offset, fullPath, texture, slot.Consequence));
            }
        }

        _materials[(file, name)] = new(material, record.Since(filesBefore));
        return material;
    }

    /// <summary>A material with the image files that it depends on.</summary>
    private sealed record ResolvedMaterial(Material Material, ImmutableDictionary<string, FileStamp> Files);

    private void Warn(Diagnostic diagnostic) => warnings.Add(diagnostic with { Severity = DiagnosticSeverity.Warning });
}
