using BenchmarkDotNet.Running;
using FractalEngine.Benchmarks;

if (args is ["table", ..])
{
    return TableCommand.Run(args.AsSpan(1));
}

if (args is ["frames", ..])
{
    return FramesCommand.Run(args.AsSpan(1));
}

if (args is ["skips", ..])
{
    return SkipsCommand.Run(args.AsSpan(1));
}

if (args is ["window", ..])
{
    return WindowCommand.Run(args.AsSpan(1));
}

if (args is ["physics", ..])
{
    return PhysicsCommand.Run(args.AsSpan(1));
}

if (args is ["growth", ..])
{
    return GrowthCommand.Run(args.AsSpan(1));
}

if (args is ["paper", ..])
{
    return PaperCommand.Run(args.AsSpan(1));
}

if (args is ["front", ..])
{
    return FrontCommand.Run(args.AsSpan(1));
}

if (args is [[not '-', ..] word, ..])
{
    Console.Error.WriteLine($"error: unknown command '{word}'");
    return 2;
}

BenchmarkSwitcher.FromAssembly(typeof(Program).Assembly).Run(args);
return 0;
