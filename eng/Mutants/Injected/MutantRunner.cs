using System.Diagnostics;
using System.Globalization;
using System.IO.MemoryMappedFiles;
using System.Reflection;
using Xunit.Abstractions;
using Xunit.Sdk;

namespace FractalEngineMutants;

/// <summary>
/// The program of the copied test assembly: runs tests one after the other in its own process, and writes what happened to a file.
/// </summary>
/// <remarks>
/// `record RESULT CLAIMS FLAGS` runs every class that no other process has claimed, and writes of each test its time, its outcome and
/// the mutants that it reached. `run RESULT LIST` runs the tests of a list until one fails. `list RESULT` writes the names of all tests.
/// </remarks>
internal static class MutantRunner
{
    private static int Main(string[] arguments)
    {
        var assembly = typeof(MutantRunner).Assembly;
        var framework = new XunitTestFramework(new NullSink());
        var information = Reflector.Wrap(assembly);
        using var discoverer = framework.GetDiscoverer(information);
        using var executor = framework.GetExecutor(assembly.GetName());
        if (arguments[0] == "record")
        {
            Record(information, discoverer, executor, arguments[1], arguments[2], arguments[3]);
        }
        else if (arguments[0] == "list")
        {
            File.WriteAllLines(arguments[1], ClassesOf(information).SelectMany(name => Discover(discoverer, name))
                .Select(test => $"{test.TestMethod.TestClass.Class.Name}\t{test.TestMethod.Method.Name}").Distinct());
        }
        else
        {
            Run(discoverer, executor, arguments[1], arguments[2]);
        }

        return 0;
    }

    private static void Record(
        IAssemblyInfo assembly, ITestFrameworkDiscoverer discoverer, ITestFrameworkExecutor executor,
        string result, string claims, string flags)
    {
        using var writer = new StreamWriter(result) { AutoFlush = true };
        foreach (string name in ClassesOf(assembly))
        {
            var cases = Discover(discoverer, name);
            if (cases.Count == 0 || !Claim(Path.Combine(claims, name)))
            {
                continue;
            }

            using var sink = new RecordingSink(writer, name, flags);
            Execute(executor, cases, sink);
            sink.EndClass();
        }
    }

    private static IEnumerable<string> ClassesOf(IAssemblyInfo assembly) =>
        assembly.GetTypes(false).Where(type => !type.IsAbstract).Select(type => type.Name).Order(StringComparer.Ordinal);

    private static bool Claim(string path)
    {
        try
        {
            using var file = new FileStream(path, FileMode.CreateNew);
            return true;
        }
        catch (IOException) when (File.Exists(path))
        {
            return false;
        }
    }

    private static void Run(ITestFrameworkDiscoverer discoverer, ITestFrameworkExecutor executor, string result, string list)
    {
        using var sink = new StoppingSink(result);
        var lines = File.ReadAllLines(list).Select(line => line.Split('\t')).ToList();
        for (int start = 0; start < lines.Count;)
        {
            int end = start;
            var limits = new Dictionary<string, double>();
            for (; end < lines.Count && lines[end][0] == lines[start][0]; end++)
            {
                limits[lines[end][1]] = double.Parse(lines[end][2], CultureInfo.InvariantCulture);
            }

            var cases = Discover(discoverer, lines[start][0]).Where(test => limits.ContainsKey(test.TestMethod.Method.Name)).ToList();
            sink.Limits = limits;
            if (cases.Count > 0)
            {
                Execute(executor, cases, sink);
            }

            sink.Idle();
            start = end;
        }

        sink.End("survived");
    }

    // Tests with a limit of time run alone, if at all: beside other mutants they would fail by chance.
    private static List<ITestCase> Discover(ITestFrameworkDiscoverer discoverer, string type)
    {
        using var sink = new DiscoverySink();
        discoverer.Find(type, false, sink, Options.Instance);
        sink.Finished.WaitOne();
        return [.. sink.Cases.Where(test => !(test.Traits.TryGetValue("Category", out var values) && values.Contains("Soak"))
            && test.TestMethod.TestClass.TestCollection.DisplayName != "Timed")];
    }

    private static void Execute(ITestFrameworkExecutor executor, List<ITestCase> cases, Sink sink)
    {
        sink.Finished.Reset();
        executor.RunTests(cases, sink, Options.Instance);
        sink.Finished.WaitOne();
    }

    private sealed class Options : ITestFrameworkDiscoveryOptions, ITestFrameworkExecutionOptions
    {
        public static readonly Options Instance = new();
        private readonly Dictionary<string, object> _values = new()
        {
            ["xunit.discovery.PreEnumerateTheories"] = false,
            ["xunit.discovery.SynchronousMessageReporting"] = true,
            ["xunit.execution.SynchronousMessageReporting"] = true,
            ["xunit.execution.DisableParallelization"] = true,
        };

        public TValue GetValue<TValue>(string name) => _values.TryGetValue(name, out object? value) ? (TValue)value : default!;

        public void SetValue<TValue>(string name, TValue value) => _values[name] = value!;
    }

    private sealed class NullSink : IMessageSink
    {
        public bool OnMessage(IMessageSinkMessage message) => true;
    }

    private abstract class Sink : IMessageSink, IDisposable
    {
        public ManualResetEvent Finished { get; } = new(false);

        public bool OnMessage(IMessageSinkMessage message)
        {
            On(message);
            if (message is ITestAssemblyFinished or IDiscoveryCompleteMessage)
            {
                Finished.Set();
            }

            return true;
        }

        public virtual void Dispose() => Finished.Dispose();

        protected abstract void On(IMessageSinkMessage message);

        protected static string? FailureOf(IMessageSinkMessage message) => message switch
        {
            ITestFailed or IErrorMessage or ITestAssemblyCleanupFailure or ITestCollectionCleanupFailure or ITestClassCleanupFailure
                or ITestMethodCleanupFailure or ITestCaseCleanupFailure or ITestCleanupFailure =>
                string.Join(" ", ((IFailureInformation)message).Messages).ReplaceLineEndings(" ").Replace('\t', ' '),
            _ => null,
        };
    }

    private sealed class DiscoverySink : Sink
    {
        public List<ITestCase> Cases { get; } = [];

        protected override void On(IMessageSinkMessage message)
        {
            if (message is ITestCaseDiscoveryMessage found)
            {
                Cases.Add(found.TestCase);
            }
        }
    }

    private sealed class RecordingSink : Sink
    {
        private readonly StreamWriter _writer;
        private readonly string _class;
        private readonly MemoryMappedFile _file;
        private readonly MemoryMappedViewAccessor _flags;
        private readonly byte[] _reached;
        private readonly HashSet<int> _aroundTests = [];
        private readonly Stopwatch _watch = new();
        private string _outcome = "passed";

        public RecordingSink(StreamWriter writer, string type, string flags)
        {
            _writer = writer;
            _class = type;
            _reached = new byte[new FileInfo(flags).Length / 3];
            _file = MemoryMappedFile.CreateFromFile(flags, FileMode.Open);
            _flags = _file.CreateViewAccessor();
        }

        public void EndClass()
        {
            _aroundTests.UnionWith(Take());
            _writer.WriteLine($"class\t{_class}\t\t0\tpassed\t{string.Join(',', _aroundTests.Order())}");
        }

        public override void Dispose()
        {
            _flags.Dispose();
            _file.Dispose();
            base.Dispose();
        }

        protected override void On(IMessageSinkMessage message)
        {
            if (message is ITestCaseStarting)
            {
                _aroundTests.UnionWith(Take());
                _outcome = "passed";
                _watch.Restart();
            }
            else if (FailureOf(message) is { } failure)
            {
                _outcome = $"failed: {failure}";
            }
            else if (message is ITestSkipped skipped && _outcome == "passed")
            {
                _outcome = $"skipped: {skipped.Reason?.ReplaceLineEndings(" ").Replace('\t', ' ')}";
            }
            else if (message is ITestCaseFinished finished)
            {
                string time = _watch.Elapsed.TotalMilliseconds.ToString("0", CultureInfo.InvariantCulture);
                string method = finished.TestCase.TestMethod.Method.Name;
                _writer.WriteLine($"test\t{_class}\t{method}\t{time}\t{_outcome}\t{string.Join(',', Take())}");
            }
        }

        private List<int> Take()
        {
            var taken = new List<int>();
            _flags.ReadArray(0, _reached, 0, _reached.Length);
            for (int id = 0; id < _reached.Length; id++)
            {
                if (_reached[id] != 0)
                {
                    taken.Add(id);
                    _flags.Write(id, (byte)0);
                }
            }

            return taken;
        }
    }

    private sealed class StoppingSink : Sink
    {
        private const double StartLimit = 60_000;
        private readonly string _result;
        private readonly Timer _timer;
        private readonly Stopwatch _watch = Stopwatch.StartNew();
        private string _current = "";
        private double _limit = StartLimit;

        public StoppingSink(string result)
        {
            _result = result;
            _timer = new(_ => Watch(), null, 200, 200);
        }

        public Dictionary<string, double> Limits { get; set; } = [];

        public void Idle()
        {
            _limit = StartLimit;
            _watch.Restart();
        }

        /// <summary>Ends the process at once: tests that go on in the background must not delay it.</summary>
        public void End(string outcome)
        {
            lock (_timer)
            {
                File.WriteAllText(_result + ".new", outcome + "\n");
                File.Move(_result + ".new", _result);
                Process.GetCurrentProcess().Kill();
                Thread.Sleep(Timeout.Infinite);
            }
        }

        public override void Dispose()
        {
            _timer.Dispose();
            base.Dispose();
        }

        protected override void On(IMessageSinkMessage message)
        {
            if (message is ITestCaseStarting starting)
            {
                string method = starting.TestCase.TestMethod.Method.Name;
                _current = $"{starting.TestCase.TestMethod.TestClass.Class.Name}.{method}";
                File.WriteAllText(_result + ".current", _current);
                _limit = Limits.GetValueOrDefault(method, StartLimit);
                _watch.Restart();
            }
            else if (FailureOf(message) is { } failure)
            {
                End($"failed\t{_current}\t{failure}");
            }
        }

        private void Watch()
        {
            if (_watch.Elapsed.TotalMilliseconds > _limit)
            {
                End($"timeout\t{_current}\t{_limit:0} ms");
            }
        }
    }
}
