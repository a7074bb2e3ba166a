using System.Buffers;
using System.Runtime.ExceptionServices;
using System.Text;
using FractalEngine.Core;
using FractalEngine.Parsing.Meshes;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Wavefront;

/// <summary>
/// Reads OBJ files block by block on several threads. A fast kernel reads plain lines, <see cref="ObjParser"/> all others and all errors.
/// </summary>
/// <remarks>
/// The result does not depend on the number of threads: blocks are scanned in any order, and added in that of the file. Memory: twice the
/// arrays of the mesh, and some megabytes. Cost: about a second per GB and thread.
/// </remarks>
public sealed class ObjReader
{
    /// <summary>Size of a block in bytes: it stays in the second-level cache from reading to parsing.</summary>
    internal const int DefaultBlockSize = 1 << 18;

    // More threads would wait for memory.
    private const int MaxThreads = 8;

    // Bytes between two reports of progress, at least.
    private const int ProgressInterval = 1 << 20;

    private readonly string _fileName;
    private readonly Encoding _encoding;
    private readonly IProgress<double>? _progress;
    private readonly int _threadCount;
    private readonly ObjBlockReader _blocks;
    private readonly ObjContents _contents = new();

    // Guards all fields below, and the contents.
    private readonly object _turn = new();
    private int _addedCount;
    private int _line = 1;
    private long _addedEnd;
    private SourceText _firstLine;
    private Exception? _failure;
    private bool _isStopped;
    private bool _isBinary;

    private ObjReader(
        Stream stream, string fileName, Encoding encoding, IProgress<double>? progress, int blockSize, int threadCount)
    {
        _fileName = fileName;
        _encoding = encoding;
        _progress = progress;
        _blocks = new(stream, fileName, blockSize);
        _threadCount = (int)Math.Clamp(_blocks.Length / blockSize, 1, threadCount);
        _firstLine = new(fileName, "");
    }

    /// <summary>Reads an OBJ file without its materials.</summary>
    /// <param name="path">Path of the file, absolute or relative to the current directory; one that ends in .gz is decompressed.</param>
    /// <param name="fileName">Name of the file in messages.</param>
    /// <param name="progress">Receives the fraction that is done, from 0 to 1, on the calling thread.</param>
    /// <exception cref="SourceException">The file can't be read, is not an OBJ file, or refers to elements that don't exist.</exception>
    public static ParsedObj Read(string path, string fileName, IProgress<double>? progress = null)
    {
        using var file = SourceText.OpenFile(path, fileName, ParsingLimits.ObjBytes.Value);
        if (!FileKinds.IsCompressed(path))
        {
            return Read(file, fileName, progress);
        }

        using var contents = CompressedFile.Decompress(file, fileName, ParsingLimits.ObjBytes.Value);
        return Read(contents, fileName, progress) with { ByteCount = file.Length };
    }

    /// <summary>Reads an OBJ file from a stream that can seek.</summary>
    internal static ParsedObj Read(
        Stream stream, string fileName, IProgress<double>? progress = null, int blockSize = DefaultBlockSize, int threadCount = 0)
    {
        if (SourceText.Access(fileName, () => FindUtf16(stream)) is { } utf16)
        {
            using var text = SourceText.Access(fileName, () => Utf16Text.ToUtf8(stream, utf16));
            return Read(text, fileName, progress, blockSize, threadCount) with { ByteCount = stream.Length };
        }

        threadCount = threadCount > 0 ? threadCount : Math.Min(Environment.ProcessorCount, MaxThreads);
        progress = progress is null ? null : new IncreasingProgress(progress);
        // A file is UTF-8 unless any of its bytes says otherwise.
        return new ObjReader(stream, fileName, Encoding.UTF8, progress, blockSize, threadCount).TryRead()
            ?? new ObjReader(stream, fileName, Encoding.Latin1, progress, blockSize, threadCount).TryRead()!;
    }

    private static Encoding? FindUtf16(Stream stream)
    {
        var mark = new byte[Utf16Text.MarkLength];
        stream.Position = 0;
        var length = stream.ReadAtLeast(mark, mark.Length, throwOnEndOfStream: false);
        stream.Position = 0;
        return Utf16Text.FindEncoding(mark.AsSpan(0, length));
    }

    /// <summary>Reads the whole file. Returns null if it is not of the encoding.</summary>
    private ParsedObj? TryRead()
    {
        Workers.Run(_threadCount, isCaller => ReadBlocks(isCaller ? _progress : null));
        // What the caller's progress throws says nothing about the file.
        if (_failure is not null && (_failure is not FractalEngineException || _isBinary || IsRestOfEncoding()))
        {
            ExceptionDispatchInfo.Throw(_failure);
        }

        if (_isStopped)
        {
            return null;
        }

        _progress?.Report(1);
        return _contents.HasDeclaration
            ? _contents.Complete(_threadCount, _blocks.Length)
            : throw ObjParser.EmptyError(_firstLine);
    }

    /// <summary>Reads blocks until none is left, on any thread.</summary>
    private void ReadBlocks(IProgress<double>? progress)
    {
        byte[] buffer = [];
        var nextReport = (long)ProgressInterval;
        try
        {
            buffer = _blocks.RentBuffer();
            var scanner = new ObjScanner();
            while (TryTake(ref buffer, out var block))
            {
                var kind = ObjBlockReader.Classify(buffer.AsSpan(0, block.Length));
                scanner.Scan(buffer, block.Length);
                var elements = scanner.ToBlock();
                lock (_turn)
                {
                    while (_addedCount < block.Index && !_isStopped)
                    {
                        Monitor.Wait(_turn);
                    }

                    if (!_isStopped)
                    {
                        Add(buffer, block, kind, scanner, elements);
                    }

                    _addedCount++;
                    Monitor.PulseAll(_turn);
                }

                if (block.End >= nextReport)
                {
                    progress?.Report((double)block.End / _blocks.Length);
                    nextReport = block.End + ProgressInterval;
                }
            }
        }
        catch (Exception exception)
        {
            Stop(exception);
        }
        finally
        {
            ArrayPool<byte>.Shared.Return(buffer);
        }
    }

    private bool TryTake(ref byte[] buffer, out ObjBlockBytes block)
    {
        lock (_blocks)
        {
            block = default;
            return !Volatile.Read(ref _isStopped) && _blocks.TryRead(ref buffer, out block);
        }
    }

    private void Stop(Exception? failure)
    {
        lock (_turn)
        {
            _failure ??= failure;
            _isStopped = true;
            Monitor.PulseAll(_turn);
        }
    }

    /// <summary>Adds a block to the contents, all before it being there.</summary>
    private void Add(byte[] buffer, ObjBlockBytes block, ObjTextKind kind, ObjScanner scanner, MeshBlock elements)
    {
        _addedEnd = block.End;
        if (kind == ObjTextKind.Binary)
        {
            _isBinary = true;
            lock (_blocks)
            {
                throw _blocks.CreateNulError(block.Position + buffer.AsSpan(0, block.Length).IndexOf((byte)0));
            }
        }

        if (kind == ObjTextKind.Latin1 && _encoding != Encoding.Latin1)
        {
            Stop(null);
            return;
        }

        if (scanner.Required.AreWithin(_contents.Counts))
        {
            AddScanned(buffer, block.Length, scanner, elements);
        }
        else
        {
            // Some index does not exist. The grammar finds it.
            ParseRest(buffer, 0, block.Length);
        }

        if (block.Index == 0 && !_contents.HasDeclaration)
        {
            var length = buffer.AsSpan(0, block.Length).IndexOfAny((byte)'\n', (byte)'\r');
            _firstLine = Excerpt(buffer, 0, length < 0 ? block.Length : length, 1);
        }
    }

    /// <summary>Adds what the kernel has read, and lets the grammar read the rest.</summary>
    private void AddScanned(byte[] buffer, int length, ObjScanner scanner, MeshBlock elements)
    {
        foreach (var statement in scanner.Statements)
        {
            var source = Excerpt(buffer, statement.Start, statement.Length, _line + statement.Line);
            ObjParser.ParseStatement(source, _contents, _contents.Counts with { Faces = _contents.Counts.Faces + statement.FaceCount });
        }

        _contents.HasDeclaration |= scanner.HasDeclaration;
        _contents.Add(elements);
        _line += scanner.LineCount;
        if (scanner.ScannedLength < length)
        {
            ParseRest(buffer, scanner.ScannedLength, length);
        }
    }

    /// <summary>Parses the lines of a block from an offset on by the grammar.</summary>
    private void ParseRest(byte[] buffer, int start, int end)
    {
        var source = Excerpt(buffer, start, end - start, _line);
        ObjParser.ParseLines(source, _contents);
        _line = source.LineOf(source.Text.Length);
    }

    private SourceText Excerpt(byte[] buffer, int start, int length, int line) =>
        new(_fileName, _encoding.GetString(buffer, start, length)) { FirstLine = line };

    /// <summary>
    /// Returns whether the bytes behind an error are of the encoding. That a file is no text, or can't be read, comes before all errors
    /// in it.
    /// </summary>
    private bool IsRestOfEncoding()
    {
        var buffer = _blocks.RentBuffer();
        var isOfEncoding = true;
        _blocks.Seek(_addedEnd);
        while (_blocks.TryRead(ref buffer, out var block))
        {
            var text = buffer.AsSpan(0, block.Length);
            var kind = ObjBlockReader.Classify(text);
            if (kind == ObjTextKind.Binary)
            {
                throw _blocks.CreateNulError(block.Position + text.IndexOf((byte)0));
            }

            isOfEncoding &= kind == ObjTextKind.Utf8 || _encoding == Encoding.Latin1;
        }

        ArrayPool<byte>.Shared.Return(buffer);
        return isOfEncoding;
    }

    /// <summary>Passes on what is larger than all before: a file that turns out to be Latin-1 is read again.</summary>
    private sealed class IncreasingProgress(IProgress<double> progress) : IProgress<double>
    {
        private double _last;

        public void Report(double value)
        {
            if (value > _last)
            {
                _last = value;
                progress.Report(value);
            }
        }
    }
}
